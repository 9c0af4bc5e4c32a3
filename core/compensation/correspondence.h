// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/compensation/direct_light.h"
#include "relucent/compensation/target.h"

namespace relucent::compensation {

/// i*(j): for every projector pixel the usable camera pixel that it lights most, per pixel of a leaf's block,
/// sum over all channels; -1 where it lights none. Only direct leaves count (DirectLeaves): light that a
/// projector pixel sends outside the view returns as indirect light, which cannot be placed. Leaves below 1 %
/// of their row's brightest do not count.
std::vector<std::int32_t> brightestCorrespondence(const transport::TransportMatrix& transport,
                                                  const CameraMask& usable,
                                                  const DirectLightSettings& settings);

/// Per projector pixel: its brightest camera pixel lies within the content. The others are black.
ProjectorMask contentPixels(const std::vector<std::int32_t>& brightest, const Target& target);

}  // namespace relucent::compensation
