// SPDX-License-Identifier: MIT
#include "relucent/pipeline/command_devices.h"

#include "relucent/base/error.h"
#include "relucent/devices/camera_registry.h"
#include "relucent/devices/command/command_camera.h"
#include "relucent/pipeline/screen_devices.h"

namespace relucent::pipeline {

std::vector<CommandRigSettings::Projector> projectorsOf(const CommandRigSettings& rig) {
  std::vector<CommandRigSettings::Projector> projectors{{rig.projectorCommand, rig.projector}};
  projectors.insert(projectors.end(), rig.moreProjectors.begin(), rig.moreProjectors.end());
  return projectors;
}

std::vector<CommandRigSettings::Camera> camerasOf(const CommandRigSettings& rig) {
  std::vector<CommandRigSettings::Camera> cameras{{rig.cameraCommand, rig.cameraAddress, rig.camera}};
  cameras.insert(cameras.end(), rig.moreCameras.begin(), rig.moreCameras.end());
  return cameras;
}

CommandRigSettings withProjectors(CommandRigSettings rig,
                                  const std::vector<CommandRigSettings::Projector>& projectors) {
  require(!projectors.empty(), "no projectors");
  rig.projectorCommand = projectors.front().command;
  rig.projector = projectors.front().size;
  rig.moreProjectors.assign(projectors.begin() + 1, projectors.end());
  return rig;
}

CommandRigSettings withCameras(CommandRigSettings rig,
                               const std::vector<CommandRigSettings::Camera>& cameras) {
  require(!cameras.empty(), "no cameras");
  rig.cameraCommand = cameras.front().command;
  rig.cameraAddress = cameras.front().address;
  rig.camera = cameras.front().size;
  rig.moreCameras.assign(cameras.begin() + 1, cameras.end());
  return rig;
}

namespace {

/// Calls `visit` with every command of the rig, which it may change: of projectors, then of cameras.
template <typename Visit>
void visitCommands(RigSettings& rig, const Visit& visit) {
  const auto visitAddress = [&visit](std::string& address) {
    auto known = devices::cameraRegistry().addressFrom(address);
    if (!known || known->kind != devices::CommandCamera::kind) return;
    visit(known->place);
    address = toString(*known);
  };
  if (auto* programs = std::get_if<CommandRigSettings>(&rig)) {
    std::vector<CommandRigSettings::Projector> projectors = projectorsOf(*programs);
    for (CommandRigSettings::Projector& projector : projectors) visit(projector.command);
    std::vector<CommandRigSettings::Camera> cameras = camerasOf(*programs);
    for (CommandRigSettings::Camera& camera : cameras) {
      if (camera.address.empty())
        visit(camera.command);
      else
        visitAddress(camera.address);
    }
    *programs = withCameras(withProjectors(*programs, projectors), cameras);
  }
  if (auto* screens = std::get_if<ScreenRigSettings>(&rig)) {
    std::vector<ScreenRigSettings::Camera> cameras = camerasOf(*screens);
    for (ScreenRigSettings::Camera& camera : cameras) visitAddress(camera.address);
    *screens = withCameras(*screens, cameras);
  }
}

}  // namespace

std::vector<std::string> commandsOf(const RigSettings& rig) {
  std::vector<std::string> commands;
  RigSettings visited = rig;
  visitCommands(visited, [&commands](const std::string& command) { commands.push_back(command); });
  return commands;
}

RigSettings withCommands(RigSettings rig, const std::vector<std::string>& commands) {
  require(commands.size() == commandsOf(rig).size(), "{} commands", commands.size());
  std::size_t next = 0;
  visitCommands(rig, [&](std::string& command) { command = commands[next++]; });
  return rig;
}

std::size_t projectorCommandsOf(const RigSettings& rig) {
  const auto* programs = std::get_if<CommandRigSettings>(&rig);
  return programs == nullptr ? 0 : projectorsOf(*programs).size();
}

std::vector<Message> problemsOfDevices(const CommandRigSettings& rig) {
  std::vector<Message> found;
  const std::vector<CommandRigSettings::Projector> projectors = projectorsOf(rig);
  for (std::size_t i = 0; i < projectors.size(); ++i)
    for (std::size_t before = 0; before < i; ++before)
      if (projectors[before].command == projectors[i].command)
        found.push_back(
            RELUCENT_ENGLISH_MESSAGE("device.projector-command-twice",
                                     "projector {} and projector {} are shown by the same command: give each "
                                     "a command of its own")
                .with(as::label(before + 1), as::label(i + 1)));
  const std::vector<CommandRigSettings::Camera> cameras = camerasOf(rig);
  for (std::size_t i = 0; i < cameras.size(); ++i)
    for (std::size_t before = 0; before < i; ++before)
      if (cameras[before].command == cameras[i].command && cameras[before].address == cameras[i].address)
        found.push_back((cameras[i].address.empty()
                             ? RELUCENT_ENGLISH_MESSAGE("device.camera-command-twice",
                                                        "camera {} and camera {} photograph by the same "
                                                        "command: give each a command of its own")
                             : RELUCENT_ENGLISH_MESSAGE("device.camera-address-twice",
                                                        "camera {} and camera {} are the same camera: give "
                                                        "another address, or one with a serial number of "
                                                        "its own"))
                            .with(as::label(before + 1), as::label(i + 1)));
  return found;
}

}  // namespace relucent::pipeline
