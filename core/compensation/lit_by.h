// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/compensation/direct_light.h"

namespace relucent::compensation {

/// Where and how brightly a projector lights a camera pixel directly; light 0: it does not.
struct LitBy {
  double x = 0.0, y = 0.0;  // continuous pixels of the projector
  double light = 0.0;
};

/// Per projector, of one row.
std::vector<LitBy> litBy(const transport::TransportMatrix& transport, const DirectLeaves& direct,
                         std::size_t row);

}  // namespace relucent::compensation
