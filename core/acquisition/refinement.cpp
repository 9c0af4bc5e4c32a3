// SPDX-License-Identifier: MIT
#include "acquisition/refinement.h"

#include <limits>

#include "acquisition/colour_class.h"
#include "base/error.h"

namespace relucent {

int patternsOf(const Schedule& schedule, const Scheme& scheme, const NodeLayout& layout, int level) {
  return static_cast<int>(scheme.lights.size()) * framesOf(schedule, layout, level);
}

void divide(Tree& tree, int level, const Schedule& schedule, Watch& watch, const References& references,
            const Scheme& scheme, Progress& progress) {
  require(tree.active.blocks() <= std::numeric_limits<std::uint32_t>::max(), "{} active pairs",
          tree.active.blocks());
  PairsByColour pairs(tree.active, schedule);
  Children children(tree.active.blocks(), level > 1, scheme.restToParent);
  double total = framesOf(schedule, tree.layout, level), done = 0.0;
  for (std::uint32_t colour = 0; colour < schedule.colours; ++colour) {
    ColourClass blocks(tree, pairs.of(colour), references, scheme);
    for (int round = 0; round == 0 || (round < 3 && blocks.contradictsParents()); ++round) {
      for (int quadrant = 0; quadrant < quadrants; ++quadrant) {
        std::vector<std::uint8_t> lit = litPixels(schedule, tree.layout, colour, quadrant);
        if (lit.empty()) continue;
        blocks.measure(quadrant, lit, watch, progress);
        if (round == 0) progress.report((done += 1.0) / total);
      }
    }
    blocks.settle(children);
  }
  adopt(tree, children, references);
}

}  // namespace relucent
