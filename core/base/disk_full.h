// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/error.h"

namespace relucent {

/// Nothing was written because the disk, or the user's share of it, is full: it can be written as soon as
/// somebody has made room.
class DiskFull : public Error {
 public:
  using Error::Error;
};

}  // namespace relucent
