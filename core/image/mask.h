// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "relucent/base/error.h"
#include "relucent/image/image.h"

namespace relucent::image::detail {

/// An empty mask means every pixel.
inline bool inside(std::span<const std::uint8_t> mask, std::size_t pixel) {
  return mask.empty() || mask[pixel] != 0;
}

/// The number of pixels that a comparison of `a` and `b` counts.
/// Throws: std::logic_error if the shapes of a, b and mask differ or no pixel is left to compare.
inline std::size_t comparedPixels(const Image& a, const Image& b, std::span<const std::uint8_t> mask) {
  require(a.size() == b.size() && a.channels() == b.channels(),
          "images of {}x{}x{} and {}x{}x{} cannot be compared", a.width(), a.height(), a.channels(),
          b.width(), b.height(), b.channels());
  require(mask.empty() || mask.size() == a.pixels(), "a mask of {} values for {} pixels", mask.size(),
          a.pixels());
  const std::size_t count =
      mask.empty() ? a.pixels()
                   : a.pixels() - static_cast<std::size_t>(std::count(mask.begin(), mask.end(), 0));
  require(count > 0, "there is no pixel to compare");
  return count;
}

}  // namespace relucent::image::detail
