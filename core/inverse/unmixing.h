// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/transport/transport_matrix.h"

namespace relucent::inverse {

/// Colours that a surface reflects by less than this share of the others are treated as noise.
inline constexpr float unmixingShare = 0.03f;

/// Inverse of a 3x3 colour mixing that stays bounded where the mixing suppresses a colour:
///   U = (B^T B + (share * |B|_F)^2 I)^-1 B^T.   Zero for B = 0.
transport::ColourBlock regularisedUnmixing(const transport::ColourBlock& mixing, float share = unmixingShare);

/// U_i y_i of every camera pixel.  Shapes: 9 floats a camera pixel, row-major; 3 values a camera pixel.
/// Throws: std::logic_error if the shapes differ.
CameraStack unmixed(const std::vector<float>& unmixing, const CameraStack& camera);

}  // namespace relucent::inverse
