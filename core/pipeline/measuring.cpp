// SPDX-License-Identifier: MIT
#include "pipeline/measuring.h"

#include "acquisition/acquisition.h"
#include "base/error.h"
#include "base/file.h"
#include "base/stopwatch.h"
#include "calibration/results.h"
#include "calibration/shot_journal.h"
#include "calibration/stage_fingerprint.h"
#include "calibration/stage_progress.h"
#include "pipeline/measured_venue.h"
#include "pipeline/stored_settings.h"

namespace relucent {
namespace fs = std::filesystem;
namespace {

/// What a stage's run cost, kept with its result.
StageCost costOf(const Stopwatch& watch, const ShotTaker& shots) {
  return {watch.seconds(), shots.shots(), shots.exposures()};
}

fs::path unusedFolder(const fs::path& parent) {
  for (int number = 1;; ++number) {
    fs::path folder = parent / fmt::format("earlier-{}", number);
    std::error_code code;
    if (!fs::exists(folder, code)) return folder;
  }
}

}  // namespace

CalibrationFolder beginCalibration(const fs::path& path, const CalibrateSettings& settings) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(ErrorKind::input, found.front(),
                RELUCENT_ENGLISH_MESSAGE("calibration.change-setting-start-again",
                                         "change that setting and start again"));
  return createCalibration(path, settings);
}

Linearization measureLinearization(CalibrationFolder& folder, Rig& rig, Progress& progress) {
  const std::string inputs = fingerprintOf(folder, Stage::linearization);
  if (auto done = folder.find(Stage::linearization, inputs)) return loadLinearization(*done);
  Stopwatch watch;
  ShotJournal journal(folder.shotFolder());
  ShotTaker shots(rig, journal, std::string(nameOf(Stage::linearization)));
  Linearization linearization = linearize(shots, settingsOf(folder).linearization, progress);
  storeLinearization(folder, inputs, linearization, costOf(watch, shots));
  return linearization;
}

Acquisition measureAcquisition(CalibrationFolder& folder, Rig& rig, const Linearization& linearization,
                               const AlarmHandler& handler, Progress& progress) {
  AcquisitionObserver nobody;
  return measureAcquisition(folder, rig, linearization, handler, nobody, progress);
}

Acquisition measureAcquisition(CalibrationFolder& folder, Rig& rig, const Linearization& linearization,
                               const AlarmHandler& handler, AcquisitionObserver& observer,
                               Progress& progress) {
  const std::string inputs = fingerprintOf(folder, Stage::acquisition);
  if (auto done = folder.find(Stage::acquisition, inputs)) return loadAcquisition(*done);
  Stopwatch watch;
  ShotJournal journal(folder.shotFolder());
  ShotTaker shots(rig, journal, std::string(nameOf(Stage::acquisition)));
  Acquisition acquisition =
      acquire({shots, linearization, settingsOf(folder).acquisition, handler, &observer}, progress);
  storeAcquisition(folder, inputs, acquisition, costOf(watch, shots));
  return acquisition;
}

void measureInverse(CalibrationFolder& folder, const MeasuredVenue& venue, Progress& progress) {
  if (progressOf(folder, Stage::inverse) == StageProgress::done) return;
  Stopwatch watch;
  RidgeChoice choice = invert(venue, settingsOf(folder), progress);
  // The operator itself is not stored: making it again is quicker than reading it. What is kept is how it is
  // made: the ridge, and the trials that chose it.
  storeInverse(folder, inverseResultOf(choice, {watch.seconds()}));
}

void setShotsAside(const CalibrationFolder& folder, Stage stage) {
  const std::string begin = fmt::format("{}-", nameOf(stage));
  std::vector<fs::path> shots;
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.shotFolder(), code))
    if (entry.is_regular_file(code) && entry.path().filename().string().starts_with(begin))
      shots.push_back(entry.path());
  if (shots.empty()) return;
  fs::path aside = unusedFolder(folder.shotFolder());
  createFolder(aside);
  for (const fs::path& shot : shots) {
    fs::rename(shot, aside / shot.filename(), code);
    if (code)
      throw Error(ErrorKind::disk,
                  RELUCENT_MESSAGE("calibration.photograph-cannot-moved", "a photograph cannot be moved ({})")
                      .with(code.message()),
                  RELUCENT_MESSAGE("calibration.check-folder-may-written-try",
                                   "check that the folder may be written to, then try again"),
                  shot.string());
  }
}

}  // namespace relucent
