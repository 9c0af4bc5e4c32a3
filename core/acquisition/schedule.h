// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "relucent/transport/block_sparse.h"

namespace relucent::acquisition {

/// Which blocks of the projectors are lit together. Blocks conflict if some camera pixel sees both; blocks
/// of one colour never do, so each camera pixel's light in such a frame comes from one of them.
struct Schedule {
  static constexpr std::uint32_t dark = std::numeric_limits<std::uint32_t>::max();

  std::size_t firstNode = 0;            // the node that colourOf[0] belongs to
  std::vector<std::uint32_t> colourOf;  // per node; dark: no camera pixel needs it
  std::uint32_t colours = 0;

  std::uint32_t colour(std::size_t node) const { return colourOf[node - firstNode]; }
};

/// Colours the conflict graph of `pairs`, a matrix whose entries are the (camera pixel, node) pairs to be
/// told apart, nodes in [firstNode, firstNode + nodes).
/// 1. Greedy: a node takes the smallest colour that none of its camera pixels has seen yet; nodes with
///    large footprints first.
/// 2. The same with the nodes of most conflicts first; the schedule with fewer colours is kept.
/// 3. A few rounds over whole colour classes, in reverse order: never worse, often better.
/// Source: Sen et al. 2005 for the conflict graph; Welsh & Powell 1967 for 1 and 2; Culberson 1992 for 3.
Schedule schedule(const transport::BlockSparse& pairs, std::size_t firstNode, std::size_t nodes);

}  // namespace relucent::acquisition
