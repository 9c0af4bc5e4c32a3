// SPDX-License-Identifier: MIT
#include "fuzz/sample_calibration.h"

#include "fuzz/scratch.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/measured_venue.h"

namespace relucent::fuzz {
namespace fs = std::filesystem;
using calibration::CalibrationFolder;

const fs::path& sampleCalibration() {
  static const fs::path folder = [] {
    pipeline::CalibrateSettings settings;
    venue::VenueSettings corner;
    corner.name = "corner";
    corner.projector = {16, 16};
    corner.camera = {16, 16};
    corner.pathsPerPixel = 16;
    settings.rig = corner;
    settings.linearization.levels = 5;
    fs::path path = scratch() / "sample";
    Progress quiet;
    pipeline::calibrate(path, settings, {}, quiet);
    return path;
  }();
  return folder;
}

calibration::StageResult sampleAcquisition() {
  static const calibration::StageResult result =
      *CalibrationFolder::open(sampleCalibration(), CalibrationFolder::Access::read)
           .latest(calibration::Stage::acquisition);
  return result;
}

const std::vector<std::string>& sampleFiles() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const calibration::ResultFile& file : sampleAcquisition().files)
      if (file.name != "record.json") all.push_back(file.name);
    return all;
  }();
  return names;
}

fs::path sampleFile(const std::string& name) {
  return sampleAcquisition().folder / name;
}

inverse::WindowInverse sampleWindows() {
  Progress quiet;
  return pipeline::loadCalibration(
             CalibrationFolder::open(sampleCalibration(), CalibrationFolder::Access::read), quiet)
      .inverse;
}

}  // namespace relucent::fuzz
