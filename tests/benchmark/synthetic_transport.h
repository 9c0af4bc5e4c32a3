// SPDX-License-Identifier: MIT
#pragma once

#include "transport/block_sparse.h"
#include "transport/node_layout.h"

namespace relucent::benchmarks {

/// How many leaves a camera pixel has, and where.
struct SyntheticSettings {
  Size projector{1024, 768};
  Size camera{640, 480};
  int footprint = 4;     // the direct light: a square of this many projector pixels a side
  int coarseNodes = 24;  // interreflections: nodes of 8x8 pixels and coarser
};

/// Leaves as an acquisition finds them: each camera pixel sees the neighbouring projector pixels at its
/// place, and nodes of levels 3 to 6 spread over the projector.
BlockSparse syntheticLeaves(const SyntheticSettings& settings, const NodeLayout& layout);

/// Uniform random values.
Stack randomStack(std::size_t pixels, std::uint64_t seed);

}  // namespace relucent::benchmarks
