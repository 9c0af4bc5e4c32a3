// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace relucent::devices {

/// Where a camera is found, now and after the next start: KIND:PLACE, as "genicam:40012345". Which kinds
/// there are, and what a place of each looks like, is known to CameraRegistry, which also reads addresses.
struct CameraAddress {
  std::string kind;   // prefix of a CameraKind
  std::string place;  // for that kind alone to understand
  bool operator==(const CameraAddress&) const = default;
};

std::string toString(const CameraAddress& address);

}  // namespace relucent::devices
