// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "relucent/calibration/calibration_folder.h"
#include "relucent/inverse/windows.h"

namespace relucent::fuzz {

/// A simulated venue as small as can be, measured once, in scratch().
const std::filesystem::path& sampleCalibration();

calibration::StageResult sampleAcquisition();
/// Names of its files.
const std::vector<std::string>& sampleFiles();
std::filesystem::path sampleFile(const std::string& name);
inverse::WindowInverse sampleWindows();

}  // namespace relucent::fuzz
