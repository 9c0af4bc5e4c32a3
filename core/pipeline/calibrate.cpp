// SPDX-License-Identifier: MIT
#include "relucent/pipeline/calibrate.h"

#include "relucent/base/error.h"
#include "relucent/base/stopwatch.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/storage.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/pipeline/warm_up.h"
#include "relucent/platform/process.h"

namespace relucent::pipeline {
namespace fs = std::filesystem;
namespace {

/// The stages of a calibration, each taken from the folder where it is done already.
class Calibrating {
 public:
  Calibrating(calibration::CalibrationFolder& folder, OpenedRig& devices,
              const sentinels::AlarmHandler& handler, calibration::RoomWaiter* room)
      : folder_(folder), devices_(devices), handler_(handler), room_(room), settings_(settingsOf(folder)) {}

  CalibrateResult run(Progress& progress) {
    MeasuredCalibration measured;
    measured.rig = settings_.rig;
    Progress linearizing = progress.part(0.15, RELUCENT_MESSAGE("stage.linearizing", "Linearizing"));
    measured.linearization = measureLinearization(folder_, devices_.rig, room_, linearizing);
    linearizing.report(1.0);
    Progress acquiring = progress.part(
        0.75, RELUCENT_MESSAGE("stage.measuring-light-transport", "Measuring the light transport"));
    measureVenue(measured, acquiring);
    acquiring.report(1.0);
    Progress inverting = progress.part(
        0.1, RELUCENT_MESSAGE("stage.inverting-light-transport", "Inverting the light transport"));
    measureInverse(folder_, measured.venue, inverting);
    progress.report(1.0);
    CalibrateResult result = summaryOf(folder_, measured);
    result.peakMemoryBytes = platform::peakMemoryBytes();
    return result;
  }

 private:
  /// The acquisition itself is let go of: there is no room for two T beside the inverse.
  void measureVenue(MeasuredCalibration& measured, Progress& progress) {
    sentinels::AcquisitionObserver nobody;
    const transport::Acquisition acquisition =
        goOnMeasuring(folder_, devices_.rig, measured.linearization, handler_, nobody, {}, room_, progress);
    measured.acquisition = figuresOf(acquisition);
    measured.venue = measuredVenueOf(acquisition, settings_.threshold);
  }

  calibration::CalibrationFolder& folder_;
  OpenedRig& devices_;
  const sentinels::AlarmHandler& handler_;
  calibration::RoomWaiter* room_;
  CalibrateSettings settings_;
};

CalibrateResult runStages(calibration::CalibrationFolder& folder, const fs::path& cache,
                          const sentinels::AlarmHandler& handler, calibration::RoomWaiter* room,
                          Progress& progress) {
  CalibrateSettings settings = settingsOf(folder);
  Progress opening = progress.part(0.2, RELUCENT_MESSAGE("stage.preparing-devices", "Preparing the devices"));
  // What was measured needs no light.
  const bool measures =
      calibration::progressOf(folder, calibration::Stage::acquisition) != calibration::StageProgress::done;
  ProjectorWarmUp warmUp(measures ? settings.network : NetworkProjectors(), settings.rig);
  warmUp.switchOn(opening);
  OpenedRig devices = openRig(settings.rig, cache, opening);
  warmUp.awaitSteadyLight(devices.rig, opening);
  opening.report(1.0);
  Progress measuring = progress.part(0.8, RELUCENT_MESSAGE("stage.calibrating", "Calibrating"));
  CalibrateResult result = Calibrating(folder, devices, handler, room).run(measuring);
  result.findings.insert(result.findings.begin(), warmUp.remarks().begin(), warmUp.remarks().end());
  return result;
}

}  // namespace

CalibrateResult calibrate(const fs::path& path, const CalibrateSettings& settings, const Storage& storage,
                          const fs::path& cache, const sentinels::AlarmHandler& handler, Progress& progress) {
  calibration::CalibrationFolder folder = beginCalibration(path, settings);
  keepPhotographs(folder, storage.kept);
  return runStages(folder, cache, handler, storage.room, progress);
}

CalibrateResult calibrate(const fs::path& path, const CalibrateSettings& settings, const fs::path& cache,
                          const sentinels::AlarmHandler& handler, Progress& progress) {
  return calibrate(path, settings, Storage(), cache, handler, progress);
}

CalibrateResult calibrate(const fs::path& path, const CalibrateSettings& settings, const fs::path& cache,
                          Progress& progress) {
  return calibrate(path, settings, cache, {}, progress);
}

CalibrateResult resume(const fs::path& path, calibration::RoomWaiter* room, const fs::path& cache,
                       const sentinels::AlarmHandler& handler, Progress& progress) {
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::open(path, calibration::CalibrationFolder::Access::write);
  return runStages(folder, cache, handler, room, progress);
}

CalibrateResult resume(const fs::path& path, const fs::path& cache, const sentinels::AlarmHandler& handler,
                       Progress& progress) {
  return resume(path, nullptr, cache, handler, progress);
}

CalibrateResult resume(const fs::path& path, const fs::path& cache, Progress& progress) {
  return resume(path, cache, {}, progress);
}

}  // namespace relucent::pipeline
