// SPDX-License-Identifier: MIT
#include "relucent/pipeline/rehearsed_venue.h"

#include "relucent/devices/temporary_folder.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/watched_calibration.h"

namespace relucent::pipeline {

RehearsedVenue::RehearsedVenue(const venue::VenueSettings& settings, const std::filesystem::path& cache,
                               Progress& progress) {
  CalibrateSettings calibrating;
  calibrating.rig = settings;
  const devices::TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path() / "venue";
  Progress measuringPart = progress.part(0.8, progress.stage());
  calibrate(folder, calibrating, cache, measuringPart);
  Progress loading = progress.part(0.2, progress.stage());
  measured = loadCalibration(
      calibration::CalibrationFolder::open(folder, calibration::CalibrationFolder::Access::read), loading);
  watched = watchedVenueOf(measured, 0);
  compensator.emplace(measured.venue, measured.inverse);
  truth = std::make_shared<const venue::SimulatedVenue>(settings, cache, progress);
}

}  // namespace relucent::pipeline
