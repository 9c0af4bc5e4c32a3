// SPDX-License-Identifier: MIT
#include "relucent/devices/listed_camera.h"

#include <utility>

#include "relucent/base/error.h"

namespace relucent::devices {

ListedCamera judged(std::string address, Message model,
                    const std::function<std::unique_ptr<CameraDriver>()>& open,
                    const DrivenCameraSettings& settings) {
  ListedCamera camera{std::move(address), std::move(model), false};
  try {
    camera.traits = DrivenCamera(open(), settings).traits();
    camera.usable = true;
  } catch (const Error& error) {
    camera.problem = RELUCENT_MESSAGE("sentence.with-advice", "{}; {}").with(error.summary(), error.advice());
  }
  return camera;
}

}  // namespace relucent::devices
