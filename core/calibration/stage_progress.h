// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "relucent/calibration/calibration_folder.h"

namespace relucent::calibration {

/// Where a stage stands.
enum class StageProgress {
  open,   // was never done
  stale,  // was done with other settings
  done
};
StageProgress progressOf(const CalibrationFolder& folder, Stage stage);

/// The newest result for the settings as they are; none: the stage has to be done.
std::optional<StageResult> currentResultOf(const CalibrationFolder& folder, Stage stage);

/// The same, else the newest of all; none if the stage was never done.
std::optional<StageResult> resultOf(const CalibrationFolder& folder, Stage stage);

/// What is current counts as the newest, whatever was made since with other settings: before those of now are
/// left, so that it stays in use until there is something new. Throws: Error{disk}.
void keepInUse(CalibrationFolder& folder);

}  // namespace relucent::calibration
