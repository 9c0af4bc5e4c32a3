// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relucent/acquisition/schedule.h"
#include "relucent/transport/node_layout.h"

namespace relucent::acquisition {

/// The child of `parent` in a quadrant, 0 to 3 row by row, if it is not cut off by the border.
bool childOf(const transport::NodeLayout& layout, const transport::Node& parent, int quadrant,
             transport::Node& child);

/// A camera pixel and the one of its active nodes that a colour lights.
struct LitPair {
  std::uint32_t row;
  std::uint32_t pair;
};

/// The active pairs, colour after colour.
struct PairsByColour {
  PairsByColour(const transport::BlockSparse& active, const Schedule& schedule);
  std::span<const LitPair> of(std::uint32_t colour) const {
    return {seen.data() + start[colour], start[colour + 1] - start[colour]};
  }

  std::vector<std::size_t> start;
  std::vector<LitPair> seen;
};

/// Which projector pixels a colour lights in a quadrant, one value a pixel. Empty: none.
std::vector<std::uint8_t> litPixels(const Schedule& schedule, const transport::NodeLayout& layout,
                                    std::uint32_t colour, int quadrant);

/// The share of every node's block that is lit.
std::vector<float> litShares(const std::vector<std::uint8_t>& lit, const transport::NodeLayout& layout);

/// Quadrant q of colour c lights anything: [quadrants * c + q].
std::vector<std::uint8_t> litQuadrants(const Schedule& schedule, const transport::NodeLayout& layout,
                                       int level);

/// Quadrants of colours that light anything: the patterns of one level, in one light.
int framesOf(const Schedule& schedule, const transport::NodeLayout& layout, int level);

}  // namespace relucent::acquisition
