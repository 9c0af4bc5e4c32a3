// SPDX-License-Identifier: MIT
#include <string>

#include "relucent/base/error.h"
#include "relucent/devices/camera_kind.h"
#include "relucent/devices/command/command_camera.h"

namespace relucent::devices {
namespace {

std::unique_ptr<rig::Camera> openCommand(const std::string& command, const CameraWishes& wishes) {
  CommandCameraSettings settings;
  settings.command = command;
  settings.size = wishes.size;
  settings.exposures = wishes.exposures;
  if (wishes.ofSeveral > 0) settings.name += " " + std::to_string(wishes.ofSeveral);
  const std::vector<Message> found = problems(settings);
  if (!found.empty())
    throw Error(ErrorKind::usage, found.front(),
                RELUCENT_ENGLISH_MESSAGE("device.follow-command-example",
                                         "write it like this: command:./photograph {exposure} {output}"));
  return std::make_unique<CommandCamera>(std::move(settings));
}

}  // namespace

CameraKind commandKind() {
  return {
      .prefix = CommandCamera::kind,
      .place = "CMD",
      .help = "a program that photographs {exposure} seconds into {output}",
      .support = RELUCENT_ENGLISH_MESSAGE("device.commands", "anything that a program of yours can drive"),
      .open = openCommand,
      .problems = problemsOfCameraCommand};
}

}  // namespace relucent::devices
