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

void keepInUse(CalibrationFolder& folder) {
  for (Stage stage : allValues<Stage>())
    if (const auto current = currentResultOf(folder, stage); current)
      folder.makeLatest(stage, current->inputs);
}

}  // namespace relucent::calibration
