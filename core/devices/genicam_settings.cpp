// SPDX-License-Identifier: MIT
#include "devices/genicam_driver.h"

namespace relucent {

std::vector<std::string> problems(const GenicamSettings& settings) {
  std::vector<std::string> found;
  if (settings.camera.empty()) found.push_back("it is not said which GenICam camera is meant");
  if (settings.photograph && settings.photograph->empty())
    found.push_back("a part of the sensor without pixels cannot be photographed");
  if (!settings.format.empty() && !sensorFormatFromName(settings.format))
    found.push_back("the pixel format " + settings.format + " cannot be read");
  if (settings.packetSize < 0) found.push_back("packets cannot be smaller than nothing");
  return found;
}

}  // namespace relucent
