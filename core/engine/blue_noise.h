// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace relucent {

/// Thresholds for dithering, `side` x `side`, to be repeated over the picture: every one of (k + 1/2) /
/// side^2 once, spread so that what is set below any threshold looks even and has no low frequencies. The
/// void-and-cluster method with a Gaussian of 1.5 pixels on the torus; the same numbers every time. Source:
/// Ulichney, The void-and-cluster method for dither array generation, SPIE 1913, 1993.
std::vector<float> blueNoise(int side);

}  // namespace relucent
