// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/image/image.h"

namespace relucent::mapping {

/// The bytes of a portable float map of three channels: little-endian floats, lines from below.
/// Source: netpbm, pfm(5).
std::string encodePfm(const image::Image& image);

}  // namespace relucent::mapping
