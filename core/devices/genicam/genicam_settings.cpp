// SPDX-License-Identifier: MIT
#include "relucent/base/message.h"
#include "relucent/devices/genicam/genicam_driver.h"

namespace relucent::devices {

std::vector<Message> problems(const GenicamSettings& settings) {
  std::vector<Message> found;
  if (settings.camera.empty())
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.genicam-camera-not-named",
                                             "it is not said which GenICam camera is meant"));
  if (settings.photograph && settings.photograph->empty())
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.sensor-part-empty",
                                             "the part of the sensor to photograph has no pixels"));
  if (!settings.format.empty() && !sensorFormatFromName(settings.format))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.pixel-format-cannot-be-read", "the pixel format {} cannot be read")
            .with(settings.format));
  if (settings.packetSize < 0)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("device.packet-size-negative", "the packet size cannot be negative"));
  return found;
}

}  // namespace relucent::devices
