// SPDX-License-Identifier: MIT
#include "base/error.h"
#include "base/stopwatch.h"
#include "calibration/results.h"
#include "calibration/shot_journal.h"
#include "pipeline/devices.h"
#include "pipeline/measured_venue.h"
#include "pipeline/pipeline.h"
#include "pipeline/settings_json.h"
#include "pipeline/stages.h"

namespace relucent {
namespace fs = std::filesystem;
namespace {

/// The stages of a calibration, each taken from the folder where it is done already.
class Calibrating {
 public:
  Calibrating(CalibrationFolder& folder, OpenedRig& devices, const AlarmHandler& handler)
      : folder_(folder),
        devices_(devices),
        handler_(handler),
        journal_(folder.shotFolder()),
        settings_(settingsOf(folder)) {}

  CalibrateResult run(Progress& progress) {
    MeasuredCalibration measured;
    measured.rig = settings_.rig;
    Progress linearizing = progress.part(0.15, "Linearizing");
    measured.linearization = linearized(linearizing);
    linearizing.report(1.0);
    Progress acquiring = progress.part(0.75, "Measuring the light transport");
    measured.acquisition = acquired(measured.linearization, acquiring);
    acquiring.report(1.0);
    Progress inverting = progress.part(0.1, "Inverting the light transport");
    measured.venue = takeMeasuredVenue(measured.acquisition, settings_.threshold);
    inverted(measured.venue, inverting);
    progress.report(1.0);
    CalibrateResult result = summaryOf(folder_, measured);
    result.peakMemoryBytes = peakMemoryBytes();
    return result;
  }

 private:
  /// What a stage's run cost, kept with its result.
  Json cost(const Stopwatch& watch, const ShotTaker* shots) const {
    Json values{{"seconds", watch.seconds()}};
    values["patterns"] = shots != nullptr ? shots->shots() : 0;
    values["exposures"] = shots != nullptr ? shots->exposures() : 0;
    return values;
  }

  Linearization linearized(Progress& progress) {
    std::string inputs = linearizationFingerprint(folder_);
    if (auto done = folder_.find(stage::linearization, inputs)) return loadLinearization(*done);
    Stopwatch watch;
    ShotTaker shots(devices_.rig, journal_, stage::linearization);
    Linearization linearization = linearize(shots, settings_.linearization, progress);
    storeLinearization(folder_, inputs, linearization, cost(watch, &shots));
    return linearization;
  }

  Acquisition acquired(const Linearization& linearization, Progress& progress) {
    std::string inputs = acquisitionFingerprint(folder_);
    if (auto done = folder_.find(stage::acquisition, inputs)) return loadAcquisition(*done);
    Stopwatch watch;
    ShotTaker shots(devices_.rig, journal_, stage::acquisition);
    Acquisition acquisition = acquire(shots, linearization, settings_.acquisition, handler_, progress);
    storeAcquisition(folder_, inputs, acquisition, cost(watch, &shots));
    return acquisition;
  }

  /// The operator itself is not stored: making it again is quicker than reading it. What is kept is how it
  /// is made: the ridge, and the trials that chose it.
  void inverted(const MeasuredVenue& venue, Progress& progress) {
    std::string inputs = inverseFingerprint(folder_);
    if (folder_.isCurrent(stage::inverse, inputs)) return;
    Stopwatch watch;
    RidgeChoice choice = invert(venue, settings_, progress);
    Json curve = Json::array();
    for (const RidgeTrial& trial : choice.curve)
      curve.push_back({{"ridge", trial.ridge}, {"psnr", trial.psnr}});
    folder_.store(stage::inverse, inputs,
                  Json{{"ridge", choice.ridge},
                       {"curve", curve},
                       {"bytes", choice.inverse.bytes()},
                       {"cost", cost(watch, nullptr)}});
  }

  CalibrationFolder& folder_;
  OpenedRig& devices_;
  const AlarmHandler& handler_;
  ShotJournal journal_;
  CalibrateSettings settings_;
};

CalibrateResult runStages(CalibrationFolder& folder, const fs::path& cache, const AlarmHandler& handler,
                          Progress& progress) {
  CalibrateSettings settings = settingsOf(folder);
  Progress opening = progress.part(0.2, "Preparing the devices");
  OpenedRig devices = openRig(settings.rig, cache, opening);
  opening.report(1.0);
  Progress measuring = progress.part(0.8, "Calibrating");
  return Calibrating(folder, devices, handler).run(measuring);
}

}  // namespace

CalibrateResult calibrate(const fs::path& path, const CalibrateSettings& settings, const fs::path& cache,
                          const AlarmHandler& handler, Progress& progress) {
  if (std::vector<std::string> found = problems(settings); !found.empty())
    throw Error(ErrorKind::input, found.front(), "change that setting and start again");
  CalibrationFolder folder = CalibrationFolder::create(path, rigToJson(settings.rig), stagesToJson(settings));
  return runStages(folder, cache, handler, progress);
}

CalibrateResult calibrate(const fs::path& path, const CalibrateSettings& settings, const fs::path& cache,
                          Progress& progress) {
  return calibrate(path, settings, cache, {}, progress);
}

CalibrateResult resume(const fs::path& path, const fs::path& cache, const AlarmHandler& handler,
                       Progress& progress) {
  CalibrationFolder folder = CalibrationFolder::open(path, CalibrationFolder::Access::write);
  return runStages(folder, cache, handler, progress);
}

CalibrateResult resume(const fs::path& path, const fs::path& cache, Progress& progress) {
  return resume(path, cache, {}, progress);
}

}  // namespace relucent
