// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "relucent/image/image.h"

namespace relucent::image {

/// A picture with the statistics of natural images: discs that occlude each other, their number falling as
/// r^-3, in colours of moderate saturation. Linear, three channels, values 0 to 1; drawn at four times the
/// size and averaged down, so that edges are as smooth as in a photograph.
/// Source: Lee, Mumford & Huang, Occlusion models for natural images, IJCV 41, 2001.
/// Contract: at least 8x8 pixels.
Image deadLeaves(Size size, std::uint64_t seed);

}  // namespace relucent::image
