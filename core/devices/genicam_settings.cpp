// SPDX-License-Identifier: MIT
#include "relucent/base/message.h"
#include "relucent/devices/genicam_driver.h"

namespace relucent::devices {

std::vector<Message> problems(const GenicamSettings& settings) {
  std::vector<Message> found;
  if (settings.camera.empty())
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.not-said-genicam-camera-meant",
                                             "it is not said which GenICam camera is meant"));
  if (settings.photograph && settings.photograph->empty())
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.part-sensor-without-pixels-cannot",
                                             "a part of the sensor without pixels cannot be photographed"));
  if (!settings.format.empty() && !sensorFormatFromName(settings.format))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.pixel-format-cannot-be-read", "the pixel format {} cannot be read")
            .with(settings.format));
  if (settings.packetSize < 0)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.packets-cannot-smaller-than-nothing",
                                             "packets cannot be smaller than nothing"));
  return found;
}

}  // namespace relucent::devices
