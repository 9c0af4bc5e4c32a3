// SPDX-License-Identifier: MIT
#include "relucent/calibration/stage_fingerprint.h"

#include "relucent/base/fingerprint.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/results.h"

namespace relucent::calibration {
namespace {

std::string hashOf(const Json& json) {
  return Fingerprint().add(json.dump()).hex();
}

/// What the stages after `stage` are given.
std::string fingerprintOfResult(const CalibrationFolder& folder, Stage stage, const Json& settings) {
  std::string inputs = fingerprintOf(folder, stage, settings);
  if (stage != Stage::acquisition) return inputs;
  const std::optional<StageResult> measured = folder.find(stage, inputs);
  if (!measured) {
    // An earlier measurement is used until there is a new one: what it comes to is not the new one's.
    const std::optional<StageResult> earlier = folder.latest(stage);
    return earlier ? hashOf(Json{{"inputs", inputs}, {"earlier", earlier->inputs}}) : inputs;
  }
  const auto result = resultFrom<Stage::acquisition>(*measured);
  if (result.isWhole()) return inputs;
  const int patterns = result.cost ? result.cost->patterns : 0;
  return hashOf(Json{{"inputs", inputs}, {"stopped_at", result.stoppedAt}, {"patterns", patterns}});
}

}  // namespace

std::string fingerprintAfter(const std::string& inputs, const StageDescription& stage, const Json& settings) {
  std::string fingerprint = inputs;
  for (std::string_view section : stage.sections)
    if (!section.empty())
      fingerprint = hashOf(Json{{"inputs", fingerprint},
                                {"stage", section},
                                {"settings", settings.value(std::string(section), Json::object())}});
  if (!stage.choice.empty() && settings.contains(stage.choice))
    fingerprint = hashOf(Json{{"inputs", fingerprint},
                              {"stage", stage.choice},
                              {"settings", settings.at(std::string(stage.choice))}});
  if (stage.version > 1)
    fingerprint = hashOf(Json{{"inputs", fingerprint}, {"stage", stage.name}, {"version", stage.version}});
  return fingerprint;
}

std::string fingerprintOf(const CalibrationFolder& folder, Stage stage, const Json& settings) {
  const StageDescription& description = descriptionOf(stage);
  const std::string inputs = description.predecessor
                                 ? fingerprintOfResult(folder, *description.predecessor, settings)
                                 : hashOf(folder.rig());
  return fingerprintAfter(inputs, description, settings);
}

std::string fingerprintOf(const CalibrationFolder& folder, Stage stage) {
  return fingerprintOf(folder, stage, folder.settings());
}

}  // namespace relucent::calibration
