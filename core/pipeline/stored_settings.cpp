// SPDX-License-Identifier: MIT
#include "relucent/pipeline/stored_settings.h"

#include "relucent/base/error.h"
#include "relucent/calibration/json.h"
#include "relucent/pipeline/settings_json.h"

namespace relucent::pipeline {
namespace {

/// In a manifest's settings: where the projector's screen hangs now, if not where it was measured. No
/// fingerprint knows it.
constexpr const char* movedScreen = "screen";
/// There, how the cameras are reduced: for no person to read. calibration/stage.h names it too.
constexpr const char* reductionSection = "reduction";
constexpr const char* toBeChosen = "to be chosen";

}  // namespace

calibration::CalibrationFolder createCalibration(const std::filesystem::path& path,
                                                 const CalibrateSettings& settings) {
  return calibration::CalibrationFolder::create(path, rigToJson(settings.rig), stagesToJson(settings));
}

CalibrateSettings settingsOf(const calibration::CalibrationFolder& folder) {
  CalibrateSettings settings;
  settings.rig = measuredRigOf(folder);
  auto* screen = std::get_if<ScreenRigSettings>(&settings.rig);
  if (screen != nullptr && folder.settings().contains(movedScreen))
    screenFromJson(folder.settings().at(movedScreen), *screen);
  stagesFromJson(folder.settings(), settings);
  return settings;
}

RigSettings measuredRigOf(const calibration::CalibrationFolder& folder) {
  return rigFromJson(folder.rig());
}

void changeSettings(calibration::CalibrationFolder& folder, const CalibrateSettings& settings) {
  // Sections of other versions stay.
  calibration::Json changed = folder.settings();
  changed.update(stagesToJson(settings));
  folder.setSettings(std::move(changed));
}

std::vector<reduction::Reduction> reductionsOf(const calibration::CalibrationFolder& folder) {
  if (!hasReductions(folder)) return {};
  return reductionsFromJson(folder.settings().at(reductionSection));
}

bool hasReductions(const calibration::CalibrationFolder& folder) {
  return folder.settings().contains(reductionSection) && folder.settings().at(reductionSection).is_array();
}

void keepReductions(calibration::CalibrationFolder& folder,
                    const std::vector<reduction::Reduction>& reductions) {
  calibration::Json settings = folder.settings();
  if (reductions.empty())
    settings.erase(reductionSection);
  else
    settings[reductionSection] = reductionsToJson(reductions);
  folder.setSettings(std::move(settings));
}

void forgetReductions(calibration::CalibrationFolder& folder) {
  calibration::Json settings = folder.settings();
  settings[reductionSection] = toBeChosen;
  folder.setSettings(std::move(settings));
}

void changeRig(calibration::CalibrationFolder& folder, const RigSettings& rig) {
  if (folder.latest(calibration::Stage::linearization))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("calibration.response-already-measured",
                                         "the response of these devices has been measured already"),
                RELUCENT_ENGLISH_MESSAGE("calibration.begin-venue-for-devices",
                                         "begin a new venue for other devices"),
                folder.path().string());
  CalibrateSettings settings = settingsOf(folder);
  settings.rig = rig;
  if (std::vector<Message> found = problems(settings); !found.empty())
    throw Error(ErrorKind::input, found.front(),
                RELUCENT_ENGLISH_MESSAGE("settings.change-and-retry", "change that setting and try again"));
  calibration::Json asked = folder.settings();
  if (asked.erase(movedScreen) + asked.erase(reductionSection) > 0) folder.setSettings(std::move(asked));
  folder.setRig(rigToJson(rig));
}

void changeScreen(calibration::CalibrationFolder& folder, const ScreenRigSettings& screen) {
  const RigSettings measured = measuredRigOf(folder);
  const auto* before = std::get_if<ScreenRigSettings>(&measured);
  if (before == nullptr)
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("calibration.projector-not-screen",
                                 "the projector of this calibration is not a screen of the desktop"),
        RELUCENT_ENGLISH_MESSAGE("calibration.begin-venue-for-screen", "begin a new venue for a screen"),
        folder.path().string());
  if (before->projector != screen.projector)
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("calibration.screen-size-differs",
                                         "this screen has {} pixels and the measured projector {}")
                    .with(as::size(screen.projector), as::size(before->projector)),
                RELUCENT_ENGLISH_MESSAGE("calibration.choose-screen-same-resolution",
                                         "choose a screen of the same resolution"),
                folder.path().string());
  calibration::Json settings = folder.settings();
  settings[movedScreen] = screenToJson(screen);
  folder.setSettings(std::move(settings));
}

}  // namespace relucent::pipeline
