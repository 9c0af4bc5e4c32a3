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

std::vector<std::string> commandsOf(const RigSettings& rig) {
  std::vector<std::string> commands;
  const auto addAddressed = [&commands](const std::string& address) {
    const auto known = devices::cameraRegistry().addressFrom(address);
    if (known && known->kind == devices::CommandCamera::kind) commands.push_back(known->place);
  };
  if (const auto* programs = std::get_if<CommandRigSettings>(&rig)) {
    for (const CommandRigSettings::Projector& projector : projectorsOf(*programs))
      commands.push_back(projector.command);
    for (const CommandRigSettings::Camera& camera : camerasOf(*programs)) {
      if (camera.address.empty())
        commands.push_back(camera.command);
      else
        addAddressed(camera.address);
    }
  }
  if (const auto* screens = std::get_if<ScreenRigSettings>(&rig))
    for (const ScreenRigSettings::Camera& camera : camerasOf(*screens)) addAddressed(camera.address);
  return commands;
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
