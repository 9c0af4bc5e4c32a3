// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "relucent/image/image.h"
#include "relucent/rig/rig.h"

namespace relucent::linearization {

using Drive = std::array<float, 3>;

/// Every pixel of every projector at `drive`.
std::vector<image::Image> evenPatterns(const rig::Rig& rig, Drive drive);
/// Every pixel of one projector at `drive`, the others black.
std::vector<image::Image> evenPatterns(const rig::Rig& rig, std::size_t projector, Drive drive);

/// Every projector in square cells of random greys: light of all strengths wherever a camera looks.
std::vector<image::Image> randomGreys(const rig::Rig& rig, std::uint64_t seed);

/// Shows the first of these on all projectors, one after the other.
void showEven(rig::Rig& rig, Drive drive);

}  // namespace relucent::linearization
