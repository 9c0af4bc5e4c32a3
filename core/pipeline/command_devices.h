// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/pipeline/rig_settings.h"

namespace relucent::pipeline {

/// The projectors of a rig of external programs, in their order in T; at least one.
std::vector<CommandRigSettings::Projector> projectorsOf(const CommandRigSettings& rig);
/// Its cameras, in their order in T; at least one.
std::vector<CommandRigSettings::Camera> camerasOf(const CommandRigSettings& rig);

/// The rig with other ones.  Contract: there are some.
/// Law: withProjectors(rig, projectorsOf(rig)) is rig, and so for cameras.
CommandRigSettings withProjectors(CommandRigSettings rig,
                                  const std::vector<CommandRigSettings::Projector>& projectors);
CommandRigSettings withCameras(CommandRigSettings rig,
                               const std::vector<CommandRigSettings::Camera>& cameras);

/// Every command that opening the rig runs on this computer: of projectors, then of cameras.
std::vector<std::string> commandsOf(const RigSettings& rig);

/// The rig with others in their place.  Contract: as many as commandsOf(rig).
/// Law: withCommands(rig, commandsOf(rig)) is rig.
RigSettings withCommands(RigSettings rig, const std::vector<std::string>& commands);
/// How many of commandsOf(rig) are projectors'.
std::size_t projectorCommandsOf(const RigSettings& rig);

/// Devices that are named twice: one command for two projectors lights one of them, one for two cameras
/// photographs one view.
std::vector<Message> problemsOfDevices(const CommandRigSettings& rig);

}  // namespace relucent::pipeline
