// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/image/image.h"

namespace relucent::image {

/// The bytes of a JPEG of an image of 1 or 3 channels, clamped to [0, 1], 8 bits, at the quality that is
/// usual for its library. No colour transform. Throws: std::logic_error as encodePng().
std::string encodeJpeg(const Image& encoded);

}  // namespace relucent::image
