// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace relucent::monitoring {

/// Tukey's weight of a residual, (1 - (r / 4.685 s)^2)^2 within, 0 beyond: 95 % efficient for normal noise.
/// `squared`: (r / s)^2.
inline double tukeyWeight(double squared) {
  constexpr double reach = 4.685;
  const double inside = std::max(0.0, 1.0 - squared / (reach * reach));
  return inside * inside;
}

}  // namespace relucent::monitoring
