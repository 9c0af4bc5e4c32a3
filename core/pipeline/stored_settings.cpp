// SPDX-License-Identifier: MIT
#include "relucent/pipeline/stored_settings.h"

#include "relucent/base/error.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/pipeline/command_devices.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/pipeline/settings_json.h"

namespace relucent::pipeline {
namespace {

/// In a manifest's settings: where the projector's screen hangs now, if not where it was measured. No
/// fingerprint knows it.
constexpr const char* movedScreen = "screen";
/// The same of projectors beyond the first, by their numbers.
constexpr const char* moreMovedScreens = "more_screens";
/// There, too: the commands that reach the devices now, if not those that they were measured by.
constexpr const char* changedCommands = "commands";
/// There, how the cameras are reduced: for no person to read. calibration/stage.h names it too.
constexpr const char* reductionSection = "reduction";
constexpr const char* toBeChosen = "to be chosen";

void moveScreens(const calibration::Json& settings, ScreenRigSettings& rig) {
  std::vector<ScreenRigSettings::Screen> screens = screensOf(rig);
  if (screens.empty()) return;
  if (settings.contains(movedScreen)) screenFromJson(settings.at(movedScreen), screens.front());
  if (settings.contains(moreMovedScreens))
    for (std::size_t i = 1; i < screens.size(); ++i)
      if (const std::string number = std::to_string(i); settings.at(moreMovedScreens).contains(number))
        screenFromJson(settings.at(moreMovedScreens).at(number), screens[i]);
  rig = withScreens(std::move(rig), screens);
}

RigSettings withChangedCommands(const calibration::Json& settings, RigSettings rig) {
  if (!settings.contains(changedCommands)) return rig;
  const std::vector<std::string> commands = commandsFromJson(settings.at(changedCommands));
  // Another version's, or somebody's by hand: those that it was begun with are as good as any.
  if (commands.size() != commandsOf(rig).size()) return rig;
  return withCommands(std::move(rig), commands);
}

}  // namespace

calibration::CalibrationFolder createCalibration(const std::filesystem::path& path,
                                                 const CalibrateSettings& settings) {
  calibration::CalibrationFolder folder =
      calibration::CalibrationFolder::create(path, rigToJson(settings.rig), stagesToJson(settings));
  if (settings.network != NetworkProjectors()) keepNetworkProjectors(folder, settings.network);
  return folder;
}

CalibrateSettings settingsOf(const calibration::CalibrationFolder& folder) {
  CalibrateSettings settings;
  settings.rig = withChangedCommands(folder.settings(), measuredRigOf(folder));
  if (auto* screen = std::get_if<ScreenRigSettings>(&settings.rig)) moveScreens(folder.settings(), *screen);
  stagesFromJson(folder.settings(), settings);
  settings.network = networkProjectorsOf(folder);
  return settings;
}

RigSettings measuredRigOf(const calibration::CalibrationFolder& folder) {
  return rigFromJson(folder.rig());
}

void changeSettings(calibration::CalibrationFolder& folder, const CalibrateSettings& settings) {
  // Sections of other versions stay.
  calibration::Json changed = folder.settings();
  changed.update(stagesToJson(settings));
  if (changed != folder.settings()) calibration::keepInUse(folder);
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
  if (asked.erase(movedScreen) + asked.erase(moreMovedScreens) + asked.erase(changedCommands) +
          asked.erase(reductionSection) >
      0)
    folder.setSettings(std::move(asked));
  folder.setRig(rigToJson(rig));
}

void changeScreen(calibration::CalibrationFolder& folder, const ScreenRigSettings& screen,
                  std::size_t projector) {
  const RigSettings measured = measuredRigOf(folder);
  const auto* before = std::get_if<ScreenRigSettings>(&measured);
  if (before == nullptr)
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("calibration.projector-not-screen",
                                 "the projector of this calibration is not a screen of the desktop"),
        RELUCENT_ENGLISH_MESSAGE("calibration.begin-venue-for-screen", "begin a new venue for a screen"),
        folder.path().string());
  const std::vector<ScreenRigSettings::Screen> screens = screensOf(*before);
  require(projector < screens.size(), "projector {} of {}", projector, screens.size());
  if (screens[projector].projector != screen.projector)
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("calibration.screen-size-differs",
                                         "this screen has {} pixels and the measured projector {}")
                    .with(as::size(screen.projector), as::size(screens[projector].projector)),
                RELUCENT_ENGLISH_MESSAGE("calibration.choose-screen-same-resolution",
                                         "choose a screen of the same resolution"),
                folder.path().string());
  calibration::Json settings = folder.settings();
  const calibration::Json moved =
      screenToJson({screen.display, screen.projector, screen.frameRate, screen.name});
  if (projector == 0)
    settings[movedScreen] = moved;
  else
    settings[moreMovedScreens][std::to_string(projector)] = moved;
  folder.setSettings(std::move(settings));
}

void changeCommands(calibration::CalibrationFolder& folder, const std::vector<std::string>& commands) {
  CalibrateSettings changed = settingsOf(folder);
  if (commands.size() != commandsOf(changed.rig).size())
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("calibration.commands-of-other-devices",
                                         "these commands are not as many as the calibration's devices need"),
                RELUCENT_ENGLISH_MESSAGE("calibration.begin-venue-for-devices",
                                         "begin a new venue for other devices"),
                folder.path().string());
  changed.rig = withCommands(changed.rig, commands);
  if (std::vector<Message> found = problems(changed); !found.empty())
    throw Error(ErrorKind::input, found.front(),
                RELUCENT_ENGLISH_MESSAGE("settings.change-and-retry", "change that setting and try again"),
                folder.path().string());
  calibration::Json settings = folder.settings();
  settings[changedCommands] = commandsToJson(commands);
  folder.setSettings(std::move(settings));
}

}  // namespace relucent::pipeline
