// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "relucent/calibration/calibration_folder.h"

namespace relucent::gui {

/// Photographs of a stage in the journal of a calibration.
int photographsKept(const std::filesystem::path& calibration, calibration::Stage stage);

/// Those taken since its result was stored: of a measurement that was begun again and has not ended. None
/// without a result.
int photographsSince(const std::filesystem::path& calibration,
                     const std::optional<calibration::StageResult>& stored, calibration::Stage stage);

/// Photographs of the light transport that wait to be gone on with; 0: nothing was interrupted.
int photographsInterrupted(const calibration::CalibrationFolder& folder);

}  // namespace relucent::gui
