// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/message.h"

namespace relucent::transport {

/// What the look at light and view found that a measurement ended with: what was photographed since the look
/// before is left out.
struct FoundChange {
  Message what;        // a sentence
  bool moved = false;  // a camera or projector: going on needs it back at its place
  bool operator==(const FoundChange&) const = default;
};

}  // namespace relucent::transport
