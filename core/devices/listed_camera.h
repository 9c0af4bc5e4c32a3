// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "relucent/base/message.h"
#include "relucent/devices/driven_camera.h"

namespace relucent::devices {

/// A camera that is there, and what can be said about it.
struct ListedCamera {
  std::string address;  // "genicam:40012345"
  Message model;
  bool usable = false;
  Message problem{};      // what is wrong and what to do, if it is not usable
  CameraTraits traits{};  // if it is
};

/// Judges one camera by opening it for a moment: `open` gives its driver. Nothing is thrown: what fails is
/// the camera's problem.
ListedCamera judged(std::string address, Message model,
                    const std::function<std::unique_ptr<CameraDriver>()>& open,
                    const DrivenCameraSettings& settings);

}  // namespace relucent::devices
