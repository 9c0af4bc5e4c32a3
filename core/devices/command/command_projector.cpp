// SPDX-License-Identifier: MIT
#include "relucent/devices/command/command_projector.h"

#include "relucent/base/error.h"
#include "relucent/devices/command/command_consent.h"
#include "relucent/devices/command/shell_command.h"
#include "relucent/image/picture_files.h"

namespace relucent::devices {

std::vector<Message> problemsOfProjectorCommand(const std::string& command) {
  if (command.empty())
    return {RELUCENT_MESSAGE("device.projector-command-empty", "the projector's command is empty")};
  if (command.find("{image}") == std::string::npos)
    return {RELUCENT_MESSAGE("device.projector-command-lacks", "the projector's command does not contain {}")
                .with("{image}")};
  return {};
}

std::vector<Message> problems(const CommandProjectorSettings& settings) {
  std::vector<Message> found = problemsOfProjectorCommand(settings.command);
  if (settings.size.empty())
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.projector-size-empty", "a projector of {} pixels is impossible")
            .with(as::size(settings.size)));
  if (settings.bits != 8 && settings.bits != 16)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.projector-bits-unsupported",
                                             "pictures for the projector have 8 or 16 bits, not {}")
                        .with(settings.bits));
  if (settings.attempts < 1)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.projector-command-attempts-not-positive",
                                             "the projector's command needs at least one attempt"));
  if (settings.timeout.count() <= 0)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.projector-command-timeout-not-positive",
                                 "the time allowed to the projector's command must be above 0 seconds"));
  return found;
}

CommandProjector::CommandProjector(CommandProjectorSettings settings) : settings_(std::move(settings)) {
  require(problems(settings_).empty(), "{}", fmt::join(problems(settings_), "; "));
  requireConsent(settings_.command);
}

void CommandProjector::show(const image::Image& encodedDrive) {
  require(encodedDrive.size() == settings_.size && encodedDrive.channels() == 3,
          "a pattern of {}x{} pixels, {} channels for a projector of {}x{}", encodedDrive.width(),
          encodedDrive.height(), encodedDrive.channels(), settings_.size.width, settings_.size.height);
  // One name for all patterns, replaced in one step: a viewer that watches the file never sees half of one.
  const std::filesystem::path image = folder_.path() / "pattern.png";
  image::writePng(image, encodedDrive, settings_.bits);
  const std::string command = substituted(settings_.command, {{"image", image.string()}});
  for (int attempt = 1; attempt < settings_.attempts; ++attempt) {
    try {
      return runShellCommand(command, settings_.timeout, name());
    } catch (const Error&) {
      // What is still wrong the last time is told.
    }
  }
  runShellCommand(command, settings_.timeout, name());
}

}  // namespace relucent::devices
