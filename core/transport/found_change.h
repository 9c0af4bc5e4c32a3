// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/message.h"

namespace relucent::transport {

/// What the look at light and view found that a measurement ended with: what was photographed since the look
/// before is left out.
struct FoundChange {
  Message what;        // a sentence
  bool moved = false;  // or has gone: going on needs it back, what is measured anew does not
  bool operator==(const FoundChange&) const = default;
};

}  // namespace relucent::transport
