// SPDX-License-Identifier: MIT
#include "acquisition/growth.h"

#include <fmt/format.h>

#include <algorithm>

#include "acquisition/refinement.h"

namespace relucent {
namespace {

/// Divides one level. False if it was dropped on an alarm; the tree is as it was.
bool divided(Tree& tree, int level, Watch& watch, const References& references, const Scheme& scheme,
             Progress& progress) {
  const NodeLayout& layout = tree.layout;
  std::size_t nodes = 0, firstNode = 0;
  for (std::size_t projector = layout.projectors().devices(); projector-- > 0;) {
    if (level >= layout.levels(projector)) continue;
    firstNode = layout.index({static_cast<int>(projector), level, 0, 0});
    nodes += layout.gridSize(projector, level).count();
  }
  Schedule plan = schedule(tree.active, firstNode, nodes);
  int last = layout.levels() - 1;
  Progress part = progress.part(1.0 / last, fmt::format("level {} of {}: {} patterns", last - level + 1, last,
                                                        patternsOf(plan, scheme, layout, level)));
  std::vector<ColourBlock> rounding = tree.rounding;
  std::vector<LeafNoise> leafNoise = tree.leafNoise;
  std::vector<std::uint8_t> unknown = tree.unknown;
  try {
    watch.check(part);
    divide(tree, level, plan, watch, references, scheme, part);
    return true;
  } catch (const KeepAndStop&) {
    tree.rounding = std::move(rounding);
    tree.leafNoise = std::move(leafNoise);
    tree.unknown = std::move(unknown);
    return false;
  }
}

}  // namespace

Tree plantedTree(const Rasters& projectors, const References& references,
                 const std::vector<std::uint8_t>& rows) {
  Tree tree = emptyTree(NodeLayout(projectors), references);
  tree.wanted = rows;
  return tree;
}

bool growTree(Tree& tree, Watch& watch, const References& references, const Scheme& scheme, bool rootsOnly,
              Progress& progress) {
  bool kept = false;
  for (int level = tree.layout.levels() - 1; level >= 0; --level) {
    plantRoots(tree, level, references, scheme);
    if (level == 0 || tree.active.blocks() == 0) continue;
    bool goOn = !rootsOnly && !kept && !progress.stopAndKeep();
    if (goOn && divided(tree, level, watch, references, scheme, progress)) continue;
    kept = kept || goOn;
    stopDividing(tree, references);
  }
  return kept;
}

Stack leafVarianceOf(const Tree& tree) {
  Stack variance(3 * tree.leafNoise.size(), 0.0f);
  for (std::size_t row = 0; row < tree.leafNoise.size(); ++row)
    for (std::size_t c = 0; c < 3; ++c)
      variance[3 * row + c] = tree.leafNoise[row].sum[c] / std::max(1.0f, tree.leafNoise[row].leaves);
  return variance;
}

}  // namespace relucent
