// SPDX-License-Identifier: MIT
#include "relucent/calibration/stage_progress.h"

#include "relucent/calibration/stage_fingerprint.h"

namespace relucent::calibration {

StageProgress progressOf(const CalibrationFolder& folder, Stage stage) {
  if (currentResultOf(folder, stage)) return StageProgress::done;
  return folder.latest(stage) ? StageProgress::stale : StageProgress::open;
}

std::optional<StageResult> currentResultOf(const CalibrationFolder& folder, Stage stage) {
  return folder.find(stage, fingerprintOf(folder, stage));
}

std::optional<StageResult> resultOf(const CalibrationFolder& folder, Stage stage) {
  if (std::optional<StageResult> current = currentResultOf(folder, stage)) return current;
  return folder.latest(stage);
}

}  // namespace relucent::calibration
