// SPDX-License-Identifier: MIT
#include "pipeline/steps.h"

#include <fmt/format.h>

#include "base/error.h"
#include "pipeline/settings_json.h"
#include "pipeline/stages.h"

namespace relucent {
namespace {

std::string chained(const CalibrationFolder& folder, const std::string& before, const char* section) {
  return fingerprintOf(Json{{"inputs", before},
                            {"stage", section},
                            {"settings", folder.settings().value(section, Json::object())}});
}

}  // namespace

const char* toString(Step step) {
  switch (step) {
    case Step::camera:
      return "camera";
    case Step::linearization:
      return stage::linearization;
    case Step::acquisition:
      return stage::acquisition;
    case Step::threshold:
      return "threshold";
    case Step::clustering:
      return "clustering";
    case Step::content:
      break;
  }
  return "content";
}

std::string fingerprintOf(const CalibrationFolder& folder, Step step) {
  switch (step) {
    case Step::camera:
      return fingerprintOf(folder.rig());
    case Step::linearization:
      return linearizationFingerprint(folder);
    case Step::acquisition:
      return acquisitionFingerprint(folder);
    case Step::threshold:
      return chained(folder, acquisitionFingerprint(folder), toString(step));
    case Step::clustering:
    case Step::content:
      break;
  }
  return chained(folder, fingerprintOf(folder, Step::threshold), toString(step));
}

StepProgress progressOf(const CalibrationFolder& folder, Step step) {
  if (folder.isCurrent(toString(step), fingerprintOf(folder, step))) return StepProgress::done;
  return folder.latest(toString(step)) ? StepProgress::stale : StepProgress::open;
}

std::optional<StageResult> resultOf(const CalibrationFolder& folder, Step step) {
  if (auto current = folder.find(toString(step), fingerprintOf(folder, step))) return current;
  return folder.latest(toString(step));
}

void changeSettings(CalibrationFolder& folder, const CalibrateSettings& settings) {
  // Sections of other versions stay.
  Json changed = folder.settings();
  changed.update(stagesToJson(settings));
  folder.setSettings(std::move(changed));
}

void changeRig(CalibrationFolder& folder, const RigSettings& rig) {
  if (folder.latest(stage::linearization))
    throw Error(ErrorKind::input, "the response of these devices has been measured already",
                "begin a new venue for other devices", folder.path().string());
  CalibrateSettings settings = settingsOf(folder);
  settings.rig = rig;
  if (std::vector<std::string> found = problems(settings); !found.empty())
    throw Error(ErrorKind::input, found.front(), "change that setting and try again");
  if (Json asked = folder.settings(); asked.contains(movedScreen)) {
    asked.erase(movedScreen);
    folder.setSettings(std::move(asked));
  }
  folder.setRig(rigToJson(rig));
}

void changeScreen(CalibrationFolder& folder, const ScreenRigSettings& screen) {
  const RigSettings measured = rigFromJson(folder.rig());
  const auto* before = std::get_if<ScreenRigSettings>(&measured);
  if (before == nullptr)
    throw Error(ErrorKind::input, "the projector of this calibration is not a screen of the desktop",
                "begin a new venue for a screen", folder.path().string());
  if (before->projector != screen.projector)
    throw Error(
        ErrorKind::input,
        fmt::format("this screen has {}x{} pixels and the measured projector {}x{}", screen.projector.width,
                    screen.projector.height, before->projector.width, before->projector.height),
        "choose a screen of the same resolution", folder.path().string());
  Json settings = folder.settings();
  settings[movedScreen] = screenToJson(screen);
  folder.setSettings(std::move(settings));
}

void storeDecision(CalibrationFolder& folder, Step step, Json values) {
  require(step != Step::linearization && step != Step::acquisition, "{} is measured, not decided",
          toString(step));
  folder.store(toString(step), fingerprintOf(folder, step), std::move(values));
}

}  // namespace relucent
