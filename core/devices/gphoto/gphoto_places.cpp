// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>

#include "relucent/base/message.h"
#include "relucent/devices/gphoto/gphoto_driver.h"

namespace relucent::devices {

using namespace std::chrono_literals;

std::vector<Message> problems(const GphotoCameraSettings& settings) {
  std::vector<Message> found;
  if (settings.camera.empty())
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.still-camera-not-named",
                                             "it is not said which still camera is meant"));
  if (settings.photograph && settings.photograph->empty())
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.sensor-part-empty",
                                             "the part of the sensor to photograph has no pixels"));
  if (settings.iso && *settings.iso < 1)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("device.iso-not-positive", "a sensitivity is at least ISO 1"));
  return found;
}

bool isSameModel(const std::string& a, const std::string& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

DrivenCameraSettings gphotoPatience() {
  DrivenCameraSettings settings;
  settings.timeout = 20s;
  settings.attempts = 3;
  settings.reconnectFor = 180s;
  settings.reconnectPause = 2s;
  return settings;
}

std::vector<std::string> gphotoPlaces(const std::vector<GphotoCamera>& cameras) {
  std::vector<std::string> places;
  for (const GphotoCamera& camera : cameras) {
    const auto same = std::count_if(cameras.begin(), cameras.end(), [&](const GphotoCamera& other) {
      return isSameModel(other.model, camera.model);
    });
    places.push_back(same > 1 ? camera.port : camera.model);
  }
  return places;
}

}  // namespace relucent::devices
