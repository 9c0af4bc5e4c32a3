// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace relucent::engine {

/// Thresholds for dithering, `side` x `side`, to be tiled over the picture: each of (k + 1/2) / side^2 once,
/// arranged so that the pixels below any threshold are evenly spread, without low frequencies. The
/// void-and-cluster method with a Gaussian of 1.5 pixels on the torus; deterministic. Source: Ulichney, The
/// void-and-cluster method for dither array generation, SPIE 1913, 1993.
std::vector<float> blueNoise(int side);

}  // namespace relucent::engine
