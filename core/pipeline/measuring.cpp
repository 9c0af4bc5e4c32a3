// SPDX-License-Identifier: MIT
#include "relucent/pipeline/measuring.h"

#include <algorithm>
#include <array>

#include "relucent/acquisition/acquisition.h"
#include "relucent/acquisition/forecast.h"
#include "relucent/base/error.h"
#include "relucent/base/stopwatch.h"
#include "relucent/calibration/earlier_shots.h"
#include "relucent/calibration/patient_shot_log.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/shot_journal.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/linearization/test_light.h"
#include "relucent/pipeline/acquisition_record.h"
#include "relucent/pipeline/kept_photographs.h"
#include "relucent/pipeline/kept_windows.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/memory_needed.h"
#include "relucent/pipeline/reductions.h"
#include "relucent/pipeline/stopped_early.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

/// What a stage's run cost, kept with its result.
calibration::StageCost costOf(double seconds, const rig::ShotTaker& shots) {
  return {seconds, shots.shots(), shots.exposures()};
}

/// A numerical failure of what is only said of a measurement is no reason to lose it.
std::optional<Outlook> lastOf(OutlookObserver& looking) {
  try {
    return looking.last();
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// What takes the photographs of one stage and keeps them: where the disk is full, when there is room again.
class StageShots {
 public:
  /// Keeps references: `rig` and `progress` outlive it.
  StageShots(const calibration::CalibrationFolder& folder, calibration::Stage stage, rig::Rig& rig,
             calibration::RoomWaiter* waiter, const Progress& progress)
      : room_(folder.path(), waiter, progress),
        journal_(folder.shotFolder()),
        earlier_(journal_),
        log_(earlier_, room_, rig),
        taker_(rig, log_, std::string(nameOf(stage)), [this] { return workingTime(); }),
        begun_(workingTime()) {}

  rig::ShotTaker& taker() { return taker_; }
  /// It goes on where a result ended early that tells what it took.
  void goOnFrom(const calibration::StageResult& ended, double seconds) {
    std::error_code code;
    const auto when = fs::last_write_time(ended.folder, code);
    if (!code) earlier_.remember(when, seconds);
  }
  /// What this session took, pauses left out, and earlier ones for the photographs that this one has read.
  double seconds() const { return (workingTime() - begun_).count() + earlier_.seconds(); }
  /// Time of this session in which somebody was waited for.
  void leaveOut(std::chrono::duration<double> waited) { waited_ += waited; }
  /// Waits for room for a result of about so many bytes.
  void waitForResult(std::uint64_t bytes) {
    const std::uint64_t needed = bytes + calibration::PatientShotLog::spare;
    room_.waitFor(needed, needed);
  }

 private:
  /// Pauses say nothing about how long the next shots take.
  std::chrono::duration<double> workingTime() const {
    return std::chrono::steady_clock::now().time_since_epoch() - room_.allPauses() - waited_;
  }

  calibration::RoomOnDisk room_;
  calibration::ShotJournal journal_;
  calibration::EarlierShots earlier_;
  calibration::PatientShotLog log_;
  rig::ShotTaker taker_;
  std::chrono::duration<double> waited_{}, begun_{};
};

std::chrono::duration<double> pausesOf(const calibration::RoomWaiter* waiter) {
  return waiter != nullptr ? waiter->otherPauses() : std::chrono::steady_clock::duration{};
}

/// The same, in the dark, and with the time that an answer takes left out. Every shot begins by showing its
/// patterns: nothing has to be put back.
sentinels::AlarmHandler patientHandler(const sentinels::AlarmHandler& handler, rig::Rig& rig,
                                       StageShots& stage) {
  if (!handler) return {};
  return [&handler, &rig, &stage](const sentinels::Alarm& alarm) {
    linearization::showEven(rig, {0, 0, 0});
    const Stopwatch waiting;
    const sentinels::Answer answer = handler(alarm);
    stage.leaveOut(std::chrono::duration<double>(waiting.seconds()));
    return answer;
  };
}

/// At most: T, and its dozen images of what the cameras saw, before they are compressed.
std::uint64_t bytesOf(const transport::Acquisition& acquisition) {
  constexpr std::uint64_t images = 12, bytesOfPixel = 3 * sizeof(float);
  return acquisition.transport.bytes() + images * bytesOfPixel * acquisition.transport.cameras().count();
}

/// How the measurement that is gone on with went. Nobody needs it to measure: what is damaged is begun anew.
AcquisitionRecord recordOf(const calibration::StageResult& ended) {
  try {
    return loadAcquisitionRecord(ended.folder).value_or(AcquisitionRecord());
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::format && error.kind() != ErrorKind::disk) throw;
    return {};
  }
}

/// Measured on shots of the journal, as far as there are any, and stored.
transport::Acquisition acquired(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                const linearization::Linearization& linearization,
                                const sentinels::AlarmHandler& handler,
                                sentinels::AcquisitionObserver& observer,
                                const OutlookObserver::Tell& outlook, calibration::RoomWaiter* room,
                                Progress& progress) {
  rig::Rig used = reducedRig(folder, rig);
  StageShots stage(folder, calibration::Stage::acquisition, used, room, progress);
  rig::ShotTaker& shots = stage.taker();
  const std::string inputs = calibration::fingerprintOf(folder, calibration::Stage::acquisition);
  AcquisitionRecord recorded;
  if (const auto ended = folder.find(calibration::Stage::acquisition, inputs)) {
    recorded = recordOf(*ended);
    if (const auto cost = calibration::resultFrom<calibration::Stage::acquisition>(*ended).cost)
      stage.goOnFrom(*ended, cost->seconds);
  }
  ensureMemory(used, settingsOf(folder), platform::memoryLeft());
  const acquisition::AcquisitionSettings settings = settingsOf(folder).acquisition;
  RecordingObserver recording(observer, recorded);
  OutlookObserver looking(recording, outlook);
  Progress photographing = progress.part(photographedShare, progress.stage());
  transport::Acquisition acquisition = acquisition::acquire(
      {shots, linearization, settings, patientHandler(handler, rig, stage), &looking}, photographing);
  Progress concluding = progress.part(
      1.0, RELUCENT_MESSAGE("stage.concluding-measurement", "what may be expected of the result"));
  if (std::optional<Outlook> last = lastOf(looking)) {
    acquisition.expected = {last->now, last->now};
    // The test patterns are photographed anew when it goes on.
    const acquisition::AcquisitionState state{looking.levels(), shots.shots() - settings.verificationPatterns,
                                              shots.times()};
    const WorkLeft left = acquisition::forecast(acquisition::forecastDevices(used, linearization.exposures),
                                                settings, linearization.times, state);
    if (acquisition.stoppedAt > 0)
      acquisition.expected = {last->now, last->whole, left.exposures, left.seconds};
  }
  if (acquisition.stoppedAt > 0)
    acquisition.findings.insert(acquisition.findings.begin(),
                                stoppedEarly(acquisition.stoppedAt, acquisition.expected));
  if (std::optional<Message> poor = poorQuality(acquisition.expected))
    acquisition.findings.insert(acquisition.findings.begin(), *std::move(poor));
  stage.waitForResult(bytesOf(acquisition));
  concluding.report(0.5);
  Progress storing =
      concluding.part(0.5, RELUCENT_MESSAGE("stage.storing-light-transport", "storing the light transport"));
  const calibration::StageResult stored =
      calibration::storeAcquisition(folder, inputs, acquisition, costOf(stage.seconds(), shots));
  saveAcquisitionRecord(recording.record(), stored.folder);
  return acquisition;
}

}  // namespace

calibration::CalibrationFolder beginCalibration(const fs::path& path, const CalibrateSettings& settings) {
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(
        ErrorKind::input, found.front(),
        RELUCENT_ENGLISH_MESSAGE("settings.change-and-start-again", "change that setting and start again"));
  return createCalibration(path, settings);
}

linearization::Linearization measureLinearization(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                                  Progress& progress) {
  return measureLinearization(folder, rig, nullptr, progress);
}

linearization::Linearization measureLinearization(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                                  calibration::RoomWaiter* room, Progress& progress) {
  if (auto done = folder.find(calibration::Stage::linearization,
                              calibration::fingerprintOf(folder, calibration::Stage::linearization)))
    return calibration::loadLinearization(*done);
  rig::checkDevices(rig);
  const std::chrono::duration<double> pausedBefore = pausesOf(room);
  const Stopwatch choosingWatch;
  Progress choosing = progress.part(
      0.0, RELUCENT_MESSAGE("stage.choosing-camera-pixels", "Finding the camera pixels that are needed"));
  chooseReductions(folder, rig, choosing);
  const double chose = choosingWatch.seconds() - (pausesOf(room) - pausedBefore).count();
  const std::string inputs = calibration::fingerprintOf(folder, calibration::Stage::linearization);
  rig::Rig used = reducedRig(folder, rig);
  StageShots stage(folder, calibration::Stage::linearization, used, room, progress);
  rig::ShotTaker& shots = stage.taker();
  linearization::Linearization linearization =
      linearization::linearize(shots, settingsOf(folder).linearization, progress);
  for (Message& finding : findingsOf(reductionsOf(folder)))
    linearization.findings.push_back(std::move(finding));
  calibration::storeLinearization(folder, inputs, linearization, costOf(chose + stage.seconds(), shots));
  return linearization;
}

transport::Acquisition measureAcquisition(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                          const linearization::Linearization& linearization,
                                          const sentinels::AlarmHandler& handler, Progress& progress) {
  sentinels::AcquisitionObserver nobody;
  return measureAcquisition(folder, rig, linearization, handler, nobody, progress);
}

transport::Acquisition measureAcquisition(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                          const linearization::Linearization& linearization,
                                          const sentinels::AlarmHandler& handler,
                                          sentinels::AcquisitionObserver& observer, Progress& progress) {
  const std::string inputs = calibration::fingerprintOf(folder, calibration::Stage::acquisition);
  if (auto done = folder.find(calibration::Stage::acquisition, inputs))
    return calibration::loadAcquisition(*done);
  return acquired(folder, rig, linearization, handler, observer, {}, nullptr, progress);
}

transport::Acquisition goOnMeasuring(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                     const linearization::Linearization& linearization,
                                     const sentinels::AlarmHandler& handler,
                                     sentinels::AcquisitionObserver& observer,
                                     const OutlookObserver::Tell& outlook, Progress& progress) {
  return goOnMeasuring(folder, rig, linearization, handler, observer, outlook, nullptr, progress);
}

transport::Acquisition goOnMeasuring(calibration::CalibrationFolder& folder, rig::Rig& rig,
                                     const linearization::Linearization& linearization,
                                     const sentinels::AlarmHandler& handler,
                                     sentinels::AcquisitionObserver& observer,
                                     const OutlookObserver::Tell& outlook, calibration::RoomWaiter* room,
                                     Progress& progress) {
  const std::string inputs = calibration::fingerprintOf(folder, calibration::Stage::acquisition);
  const auto done = folder.find(calibration::Stage::acquisition, inputs);
  const bool isWhole = done && calibration::resultFrom<calibration::Stage::acquisition>(*done).isWhole();
  transport::Acquisition acquisition =
      isWhole ? calibration::loadAcquisition(*done)
              : acquired(folder, rig, linearization, handler, observer, outlook, room, progress);
  removePhotographs(folder);
  return acquisition;
}

bool isWorkingOut(std::string_view stage) {
  constexpr std::array<std::string_view, 4> stages{"stage.working-out-finest-blocks", "stage.sharing-leaves",
                                                   "stage.concluding-measurement",
                                                   "stage.storing-light-transport"};
  return std::ranges::find(stages, stage) != stages.end();
}

void measureInverse(calibration::CalibrationFolder& folder, const compensation::MeasuredVenue& venue,
                    Progress& progress) {
  if (calibration::progressOf(folder, calibration::Stage::inverse) == calibration::StageProgress::done)
    return;
  Stopwatch watch;
  const CalibrateSettings settings = settingsOf(folder);
  const compensation::RidgeChoice choice = invert(venue, settings, progress);
  const double seconds = watch.seconds();
  inverse::WindowSettings chosen = settings.windows;
  chosen.ridge = choice.ridge;
  // Before the result says that this is done: whoever is killed between the two chooses once more.
  keepWindows(folder, venue, chosen, choice.inverse);
  // The result is how it was made: the ridge, and the trials that chose it.
  calibration::storeInverse(folder, inverseResultOf(choice, {seconds}));
}

}  // namespace relucent::pipeline
