// SPDX-License-Identifier: MIT
#include "relucent/calibration/stage_fingerprint.h"

#include "relucent/base/fingerprint.h"
#include "relucent/calibration/json.h"

namespace relucent::calibration {
namespace {

std::string hashOf(const Json& json) {
  return Fingerprint().add(json.dump()).hex();
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

std::string fingerprintOf(const CalibrationFolder& folder, Stage stage) {
  const StageDescription& description = descriptionOf(stage);
  const std::string inputs =
      description.predecessor ? fingerprintOf(folder, *description.predecessor) : hashOf(folder.rig());
  return fingerprintAfter(inputs, description, folder.settings());
}

}  // namespace relucent::calibration
