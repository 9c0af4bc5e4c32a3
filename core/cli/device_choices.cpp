// SPDX-License-Identifier: MIT
#include "relucent/cli/device_choices.h"

#include <fmt/format.h>

#include "relucent/cli/arguments.h"
#include "relucent/devices/camera_registry.h"

namespace relucent::cli {

void CameraChoices::read(const std::string& text) {
  if (devices::cameraRegistry().addressFrom(text))
    addresses.push_back(text);
  else if (text.find(':') != std::string::npos)
    throw WrongUsage(
        fmt::format("'{}' is not a camera: write {}", text, devices::cameraRegistry().addressForms()));
  else
    sizes.push_back(parseSize(text));
}

std::vector<pipeline::CommandRigSettings::Camera> CameraChoices::chosen() const {
  const bool addressed = !addresses.empty();
  std::vector<pipeline::CommandRigSettings::Camera> cameras;
  for (const std::string& address : addresses) cameras.push_back({{}, address, std::nullopt});
  if (!addressed)
    for (const std::string& command : commands) cameras.push_back({command, {}, std::nullopt});
  const std::vector<Size>& given = addressed ? sizesOfAddressed : sizes;
  if (given.empty()) return cameras;
  const std::vector<Size> all = onePerDevice(given, cameras.size(), addressed ? "--camera-size" : "--camera");
  for (std::size_t i = 0; i < cameras.size(); ++i) cameras[i].size = all[i];
  return cameras;
}

std::vector<Size> onePerDevice(const std::vector<Size>& sizes, std::size_t devices, const char* option) {
  if (sizes.size() == devices) return sizes;
  if (sizes.size() == 1) return std::vector<Size>(devices, sizes.front());
  const std::string there = devices == 1 ? "one device" : fmt::format("{} devices", devices);
  throw WrongUsage(
      fmt::format("{} is given {} times for {}: give it once for each, in their order, or once for all",
                  option, sizes.size(), there));
}

}  // namespace relucent::cli
