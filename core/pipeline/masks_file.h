// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/json.h"
#include "relucent/compensation/target.h"

namespace relucent::pipeline {

/// Masks as calibrations and files of their own keep them, cameras counted from 1:
///   [{"camera": 1, "outline": "lines" | "curve", "feather": 0.02, "points": [[x, y], ...]}, ...]
calibration::Json masksToJson(const std::vector<compensation::Mask>& masks);
/// Throws: Error{format} that says which mask is none and why, or that it holds what this version does not
/// know: light on a door is worse than a message.
std::vector<compensation::Mask> masksFromJson(const calibration::Json& json);

/// {"masks": [...]}.  Throws: Error{disk, format}.
std::vector<compensation::Mask> readMasks(const std::filesystem::path& file);
/// Throws: Error{disk}.
void writeMasks(const std::filesystem::path& file, const std::vector<compensation::Mask>& masks);

/// A target with the masks of the calibration, where nobody has said which.
compensation::TargetSettings withMasks(compensation::TargetSettings target,
                                       const calibration::CalibrationFolder& folder);
/// Keeps other masks in a calibration. Whether its cameras are that many is seen where they are used.
/// Throws: Error{input} for masks that are none; Error{disk}.
void keepMasks(calibration::CalibrationFolder& folder, const std::vector<compensation::Mask>& masks);

}  // namespace relucent::pipeline
