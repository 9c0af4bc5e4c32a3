// SPDX-License-Identifier: MIT
#include "pipeline/stages.h"

#include "pipeline/settings_json.h"

namespace relucent {
namespace {

std::string chained(const std::string& before, const Json& settings, const char* stageName) {
  return fingerprintOf(Json{
      {"inputs", before}, {"stage", stageName}, {"settings", settings.value(stageName, Json::object())}});
}

}  // namespace

CalibrateSettings settingsOf(const CalibrationFolder& folder) {
  CalibrateSettings settings;
  settings.rig = rigFromJson(folder.rig());
  auto* screen = std::get_if<ScreenRigSettings>(&settings.rig);
  if (screen != nullptr && folder.settings().contains(movedScreen))
    screenFromJson(folder.settings().at(movedScreen), *screen);
  stagesFromJson(folder.settings(), settings);
  return settings;
}

std::string linearizationFingerprint(const CalibrationFolder& folder) {
  return chained(fingerprintOf(folder.rig()), folder.settings(), "linearization");
}

std::string acquisitionFingerprint(const CalibrationFolder& folder) {
  return chained(linearizationFingerprint(folder), folder.settings(), "acquisition");
}

std::string inverseFingerprint(const CalibrationFolder& folder) {
  std::string thresholded = chained(acquisitionFingerprint(folder), folder.settings(), "threshold");
  std::string windows = chained(thresholded, folder.settings(), "windows");
  return chained(windows, folder.settings(), "choose_ridge");
}

}  // namespace relucent
