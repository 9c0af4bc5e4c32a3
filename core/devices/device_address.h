// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace relucent {

/// Where a camera is found, now and after the next start: KIND:PLACE.
///   genicam:40012345               a GigE Vision or USB3 Vision camera by its serial number; also its
///   network
///                                  address or the name that Aravis gives it
///   gphoto2:Canon EOS 80D          a DSLR or mirrorless camera by its model; also its port, usb:001,005
///   v4l2:/dev/v4l/by-id/usb-...    a webcam by its path
///   command:./photograph {exposure} {output}   an external program
struct DeviceAddress {
  enum class Kind { genicam, gphoto2, v4l2, command };
  Kind kind = Kind::genicam;
  std::string place;
  bool operator==(const DeviceAddress&) const = default;
};

/// None unless the text begins with a kind and a colon, and names a place.
std::optional<DeviceAddress> deviceAddressFrom(std::string_view text);
std::string toString(const DeviceAddress& address);
/// "genicam:SERIAL, gphoto2:MODEL, ... or command:CMD", for sentences.
inline constexpr std::string_view deviceAddressForms =
    "genicam:SERIAL, gphoto2:MODEL, v4l2:PATH or command:CMD";

}  // namespace relucent
