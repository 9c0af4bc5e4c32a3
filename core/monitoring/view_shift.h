// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/monitoring/watched_venue.h"

namespace relucent::monitoring {

/// How a view has moved, as one photograph shows it.
struct ViewShift {
  double x = 0.0, y = 0.0;  // camera pixels, of the view's centre, right and down
  double turn = 0.0;        // camera pixels at the middle of the view's shorter side, clockwise
  double deviation = 1e9;   // standard deviation of x and of y, the larger; large: nothing tells
};

/// The movement of the picture against what is predicted, by its gradient in the patches:
///   y(u) - q(u) = -d grad q(u) + a + b q(u),   q predicted, both smoothed by a binomial of 3x3,
/// the brightness a, b of each patch and channel free, so that what T has wrong there does not matter. Each
/// patch's d is least squares over its pixels; the view's shift and turn are least squares over the patches
/// with Tukey's weights, so that visitors count for little. A film that pans moves every patch too, and its
/// moment is not known to a pixel: how far the patches move with time is a fourth unknown, so that a pan
/// tells nothing along its way. Shapes: radiance at all samples; `along`: how it changes with time, or empty.
/// Source: Lucas & Kanade, An iterative image registration technique, 1981; core/monitoring/README.md.
ViewShift viewShift(const Observed& seen, const std::vector<float>& predicted,
                    const std::vector<float>& along, const WatchedVenue& venue);

}  // namespace relucent::monitoring
