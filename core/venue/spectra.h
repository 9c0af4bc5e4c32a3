// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>

#include "relucent/transport/block_sparse.h"

namespace relucent::venue {

/// Light is carried in twelve bands of 25 nm, centred at 410, 435, ... 685 nm: enough for the colour mixing
/// to depend on the surface, as in reality.
constexpr int bandCount = 12;
using Spectrum = Eigen::Array<float, bandCount, 1>;

/// A smooth reflectance whose mean over the long, middle and short wavelengths is about `rgb`, within [0, 1]
/// where `rgb` is.
Spectrum reflectance(const Eigen::Array3f& rgb);

/// Radiance per band of the projector's channels at full drive. They overlap, as colour filters do.
const std::array<Spectrum, 3>& projectorPrimaries();

/// Response per band of the camera's channels, balanced: a white surface under all primaries gives 1, 1, 1.
const std::array<Spectrum, 3>& cameraSensitivities();

/// Transport `t` per band, converted to a block for three-channel devices: block(c, p) = sum_b S_c(b) t(b)
/// P_p(b).
transport::ColourBlock colourBlock(const Spectrum& transport);

/// Camera signal of a surface under room light (warm; 1 in the green channel of a grey surface).
Eigen::Array3f underRoomLight(const Spectrum& reflectance);

}  // namespace relucent::venue
