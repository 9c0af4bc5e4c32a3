// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/base/message.h"
#include "relucent/pipeline/rig_settings.h"

namespace relucent::pipeline {

/// The screens of a rig, in the order of their projectors in T. Empty: none is chosen yet.
std::vector<ScreenRigSettings::Screen> screensOf(const ScreenRigSettings& rig);
/// Its cameras, in their order in T. Empty: none is chosen yet.
std::vector<ScreenRigSettings::Camera> camerasOf(const ScreenRigSettings& rig);

/// The rig with other ones. Law: withScreens(rig, screensOf(rig)) is rig, and so for cameras.
ScreenRigSettings withScreens(ScreenRigSettings rig, const std::vector<ScreenRigSettings::Screen>& screens);
ScreenRigSettings withCameras(ScreenRigSettings rig, const std::vector<ScreenRigSettings::Camera>& cameras);

/// The rig as if that screen were its only one.  Contract: there is such a screen.
ScreenRigSettings withScreenAlone(ScreenRigSettings rig, std::size_t screen);

/// Screens and cameras that are named twice, and cameras that are none.
std::vector<Message> problemsOfDevices(const ScreenRigSettings& rig);

}  // namespace relucent::pipeline
