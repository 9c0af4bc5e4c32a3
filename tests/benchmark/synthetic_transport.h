// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/transport/block_sparse.h"
#include "relucent/transport/node_layout.h"

namespace relucent::benchmarks {

/// How many leaves a camera pixel has, and where.
struct SyntheticSettings {
  Size projector{1024, 768};
  Size camera{640, 480};
  int footprint = 4;     // the direct light: a square of this many projector pixels a side
  int coarseNodes = 24;  // interreflections, at random places
  int finestCoarse = 3;  // they are nodes of this level (8x8 pixels) ...
  int coarseLevels = 4;  // ... and the next coarser ones, so many levels in all
};

/// Leaves as an acquisition finds them: each camera pixel sees the neighbouring projector pixels at its
/// place, and nodes of levels 3 to 6 spread over the projector.
transport::BlockSparse syntheticLeaves(const SyntheticSettings& settings,
                                       const transport::NodeLayout& layout);

/// Leaves of a venue with depth, for what depends on how footprints overlap: direct light is a Gaussian whose
/// standard deviation grows from `sharpest` to `softest` projector pixels across the picture, down to 0.5 %
/// of its peak and with noise; a third of the rows see a second, blurred place as a mirror or a corner shows
/// it; the same coarse nodes as above. About 95 leaves a row, 29 million in all.
struct DefocusSettings {
  double sharpest = 0.7;
  double softest = 1.6;
};
transport::BlockSparse defocusedLeaves(const SyntheticSettings& settings, const DefocusSettings& defocus,
                                       const transport::NodeLayout& layout);

/// Uniform random values.
Stack randomStack(std::size_t pixels, std::uint64_t seed);

}  // namespace relucent::benchmarks
