// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "relucent/image/image.h"

namespace relucent::report {

/// CIEDE2000 of every pixel as a viewer adapted to `white` sees them; NaN where `inside` is 0.
image::Image deltaEMap(const image::Image& a, const image::Image& b, const std::array<float, 3>& white,
                       const CameraMask& inside);

/// The brightest that each pixel can get, as a multiple of white: min over channels of (flood + black) /
/// white.
image::Image reachableLight(const image::Image& flood, const image::Image& black,
                            const std::array<float, 3>& white);

/// Per channel the value that `share` of the pixels lie below: a white for pictures that have none.
std::array<float, 3> percentileWhite(const image::Image& linear, double share);

/// "data:image/png;base64,..." of an encoded image.
std::string pngDataUri(const image::Image& encoded);
std::string base64(std::string_view bytes);

}  // namespace relucent::report
