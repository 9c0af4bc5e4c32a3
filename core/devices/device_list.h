// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "devices/driven_camera.h"

namespace relucent {

/// A camera that is there, and what can be said about it.
struct ListedCamera {
  std::string address;  // for openCamera(): "genicam:40012345"
  std::string model;
  bool usable = false;
  std::string problem{};  // what is wrong and what to do, if it is not usable
  CameraTraits traits{};  // if it is
};

/// What kinds of devices this build can speak to.
struct DeviceSupport {
  std::string kind;  // "genicam"
  bool available = false;
  std::string sentence;  // what it is, or what is missing
};

struct DeviceList {
  std::vector<DeviceSupport> support;
  std::vector<ListedCamera> cameras;
};

/// Looks for cameras and opens each of them for a moment to learn what it can do and what is wrong with it.
/// Takes a second for the network and up to some seconds for a camera that does not answer.
DeviceList listDevices();

/// The part of it that judges one camera: `open` gives its driver. Nothing is thrown: what fails is told.
ListedCamera judged(std::string address, std::string model,
                    const std::function<std::unique_ptr<CameraDriver>()>& open,
                    const DrivenCameraSettings& settings);

}  // namespace relucent
