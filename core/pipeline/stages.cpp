// SPDX-License-Identifier: MIT
#include "pipeline/stages.h"

#include "pipeline/settings_json.h"

namespace relucent {
namespace {

std::string chained(const std::string& before, const Json& settings, const char* stageName) {
  return fingerprintOf(Json{{"inputs", before}, {"stage", stageName}, {"settings", settings.at(stageName)}});
}

}  // namespace

CalibrateSettings settingsOf(const CalibrationFolder& folder) {
  CalibrateSettings settings;
  settings.rig = rigFromJson(folder.rig());
  stagesFromJson(folder.settings(), settings);
  return settings;
}

std::string linearizationFingerprint(const CalibrateSettings& settings) {
  return chained(fingerprintOf(rigToJson(settings.rig)), stagesToJson(settings), "linearization");
}

std::string acquisitionFingerprint(const CalibrateSettings& settings) {
  return chained(linearizationFingerprint(settings), stagesToJson(settings), "acquisition");
}

std::string inverseFingerprint(const CalibrateSettings& settings) {
  std::string before = chained(acquisitionFingerprint(settings), stagesToJson(settings), "threshold");
  return chained(before, stagesToJson(settings), "windows");
}

}  // namespace relucent
