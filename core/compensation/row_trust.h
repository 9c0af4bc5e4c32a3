// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/compensation/expected_error.h"
#include "relucent/compensation/target.h"

namespace relucent::compensation {

/// How far each camera pixel's row of T is to be relied on, whatever is shown: MeasuredVenue::trust.
///   trust = max(0.35, 1 / (1 + 0.1 sigma^2 / (0.01 w)^2))
/// sigma^2: of expectedDeviation(), mean of the channels, when a mosaic of random colours is shown, squares
/// of a sixteenth of each projector's width; w: what 85 % of the usable pixels can show as white, T 1 + e.  A
/// weight that goes down where errors go up is what least squares with errors in T come to, one step of it.
/// Empty where nothing is known of the leaves' errors, or no pixel is usable.  Shape: the camera pixels.
/// Source: core/compensation/README.md.
std::vector<float> trustIn(const MeasuredVenue& venue, const TransportVariance& variance);

}  // namespace relucent::compensation
