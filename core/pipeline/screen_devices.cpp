// SPDX-License-Identifier: MIT
#include "relucent/pipeline/screen_devices.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/devices/camera_registry.h"

namespace relucent::pipeline {
namespace {

bool isChosen(const ScreenRigSettings& rig) {
  return !(rig.display == ScreenRigSettings::Display{}) || !rig.projector.empty();
}

}  // namespace

std::vector<ScreenRigSettings::Screen> screensOf(const ScreenRigSettings& rig) {
  if (!isChosen(rig)) return {};
  std::vector<ScreenRigSettings::Screen> screens{{rig.display, rig.projector, rig.frameRate, rig.name}};
  screens.insert(screens.end(), rig.moreScreens.begin(), rig.moreScreens.end());
  return screens;
}

std::vector<ScreenRigSettings::Camera> camerasOf(const ScreenRigSettings& rig) {
  if (rig.cameraAddress.empty()) return {};
  std::vector<ScreenRigSettings::Camera> cameras{{rig.cameraAddress, rig.camera, rig.cameraName}};
  cameras.insert(cameras.end(), rig.moreCameras.begin(), rig.moreCameras.end());
  return cameras;
}

ScreenRigSettings withScreens(ScreenRigSettings rig, const std::vector<ScreenRigSettings::Screen>& screens) {
  const ScreenRigSettings::Screen first = screens.empty() ? ScreenRigSettings::Screen{} : screens.front();
  rig.display = first.display;
  rig.projector = first.projector;
  rig.frameRate = first.frameRate;
  rig.name = first.name;
  rig.moreScreens.assign(screens.begin() + (screens.empty() ? 0 : 1), screens.end());
  return rig;
}

ScreenRigSettings withCameras(ScreenRigSettings rig, const std::vector<ScreenRigSettings::Camera>& cameras) {
  const ScreenRigSettings::Camera first = cameras.empty() ? ScreenRigSettings::Camera{} : cameras.front();
  rig.cameraAddress = first.address;
  rig.camera = first.size;
  rig.cameraName = first.name;
  rig.moreCameras.assign(cameras.begin() + (cameras.empty() ? 0 : 1), cameras.end());
  return rig;
}

ScreenRigSettings withScreenAlone(ScreenRigSettings rig, std::size_t screen) {
  const std::vector<ScreenRigSettings::Screen> screens = screensOf(rig);
  require(screen < screens.size(), "screen {} of {}", screen, screens.size());
  return withScreens(std::move(rig), {screens[screen]});
}

std::vector<Message> problemsOfDevices(const ScreenRigSettings& rig) {
  std::vector<Message> found;
  const std::vector<ScreenRigSettings::Screen> screens = screensOf(rig);
  for (std::size_t i = 0; i < screens.size(); ++i)
    for (std::size_t before = 0; before < i; ++before)
      if (screens[before].display == screens[i].display)
        found.push_back(RELUCENT_MESSAGE("device.screen-twice",
                                         "screen {} is projector {} and projector {}: choose another screen")
                            .with(screens[i].display.connector, before + 1, i + 1));
  const std::vector<ScreenRigSettings::Camera> cameras = camerasOf(rig);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::vector<Message> wrong = devices::cameraRegistry().problems(cameras[i].address);
    found.insert(found.end(), wrong.begin(), wrong.end());
    for (std::size_t before = 0; before < i; ++before)
      if (cameras[before].address == cameras[i].address)
        found.push_back(
            RELUCENT_MESSAGE("device.camera-twice",
                             "{} is camera {} and camera {}: choose another camera, or one with a "
                             "serial number of its own")
                .with(cameras[i].address, before + 1, i + 1));
  }
  return found;
}

}  // namespace relucent::pipeline
