// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "relucent/photography/photographer.h"
#include "relucent/photography/references.h"

namespace relucent::acquisition {

/// Indices of exposures, for one photograph after another, over and over. Dense patterns show a camera pixel
/// about half of its full light, whatever they are, so that the exposures follow from the floods alone:
/// - three of four photographs, or all, have the longest exposure that suits 98 % of the camera pixels;
/// - every fourth has the shortest that one of the others needs;
/// - one of four has the next longer exposure if that suits more than 15 % of the pixels.
/// What an exposure saturates is not used.
std::vector<std::size_t> exposureCycle(const photography::References& references,
                                       const photography::Photographer& photographer);

}  // namespace relucent::acquisition
