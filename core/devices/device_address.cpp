// SPDX-License-Identifier: MIT
#include "devices/device_address.h"

#include <array>
#include <utility>

namespace relucent {
namespace {

using Kind = DeviceAddress::Kind;
constexpr std::array<std::pair<std::string_view, Kind>, 4> kinds{{{"genicam:", Kind::genicam},
                                                                  {"gphoto2:", Kind::gphoto2},
                                                                  {"v4l2:", Kind::v4l2},
                                                                  {"command:", Kind::command}}};

}  // namespace

std::optional<DeviceAddress> deviceAddressFrom(std::string_view text) {
  for (const auto& [prefix, kind] : kinds)
    if (text.starts_with(prefix) && text.size() > prefix.size())
      return DeviceAddress{kind, std::string(text.substr(prefix.size()))};
  return std::nullopt;
}

std::string toString(const DeviceAddress& address) {
  for (const auto& [prefix, kind] : kinds)
    if (kind == address.kind) return std::string(prefix) + address.place;
  return address.place;
}

}  // namespace relucent
