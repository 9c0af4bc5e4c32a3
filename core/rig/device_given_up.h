// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/error.h"

namespace relucent::rig {

/// Comes instead of a photograph that nobody waits for any longer: a device does not answer, and what can be
/// made without it is to be made.
class DeviceGivenUp : public Error {
 public:
  using Error::Error;
};

}  // namespace relucent::rig
