// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "relucent/image/image.h"

namespace relucent::reduction {

/// The part of a camera's picture that the projectors light.
struct LitPart {
  Pixel begin;
  Size size;
  std::size_t pixels = 0;  // within it, as bright as what is lit directly

  bool operator==(const LitPart&) const = default;
};

/// Finds it in `light`, white less black, linear.
///  1. B, the mean of a pixel's channels and of its neighbours'. Noise: twice the 99.9th percentile of -B,
///  since
///     no light is below zero. Typical: the B above which half of all light lies.
///  2. Lit is what exceeds the noise and 0.05 of what is typical: what the room scatters everywhere is
///  fainter,
///     whatever its sum. From 0.15 on it counts as directly lit; darker surfaces do not, so that they rather
///     have too many pixels.
///  3. The rectangle outside of which, on each of its sides, lies less than 0.0005 of the lit light: a stray
///     reflection far away does not count.
/// Empty if nothing is lit.
LitPart litPart(const image::Image& light);

/// A rectangle and its surroundings: a sixteenth of its longer side more on all of its own, within `camera`.
LitPart withSurroundings(const LitPart& part, Size camera);

}  // namespace relucent::reduction
