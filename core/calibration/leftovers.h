// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "relucent/calibration/calibration_folder.h"

namespace relucent::calibration {

/// Names of what a program that was killed in the middle of a write left, beside the manifest and among the
/// results: never named by a manifest.
bool isManifestLeftover(const std::string& name);
bool isResultLeftover(const std::string& name);

/// Files that interrupted writes left, and folders of results that no manifest names: nothing reads them.
/// Opening a calibration for writing clears away most of them. Files and folders.
std::vector<std::filesystem::path> leftovers(const CalibrationFolder& folder);

/// Folders of results that nothing can find again, because a newer one was stored for the very same inputs:
/// of a measurement that was stopped and kept, once it has gone on; or because they were set aside. Results
/// for other settings are none of them: they are current again when the settings are set back. Nor is what
/// the present one was repaired from: there is a way back to it.
std::vector<std::filesystem::path> replacedResults(const CalibrationFolder& folder);

}  // namespace relucent::calibration
