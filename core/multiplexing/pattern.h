// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "relucent/base/raster.h"

namespace relucent::multiplexing {

/// A dense pattern of random colours: every channel of every node of `level` is lit or dark by chance, in all
/// projectors at once. Values are 0 or 1, full drive, so that no projector curve is needed. A projector whose
/// pyramid is lower is lit as a whole. The same bits for the same level, number and seed.
ProjectorStack blockPattern(const Rasters& projectors, int level, int number, std::uint64_t seed);

}  // namespace relucent::multiplexing
