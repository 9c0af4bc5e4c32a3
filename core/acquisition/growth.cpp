// SPDX-License-Identifier: MIT
#include "acquisition/growth.h"

#include <fmt/format.h>

#include <algorithm>

#include "acquisition/forecast.h"
#include "acquisition/refinement.h"

namespace relucent {
namespace {

/// The blocks of one level that matter, in colours.
Schedule scheduleOf(const Tree& tree, int level) {
  const NodeLayout& layout = tree.layout;
  std::size_t nodes = 0, firstNode = 0;
  for (std::size_t projector = layout.projectors().devices(); projector-- > 0;) {
    if (level >= layout.levels(projector)) continue;
    firstNode = layout.index({static_cast<int>(projector), level, 0, 0});
    nodes += layout.gridSize(projector, level).count();
  }
  return schedule(tree.active, firstNode, nodes);
}

/// How much of the tree's work has been handed out, by what is known and expected of its levels.
class Shares {
 public:
  /// The share of the level that begins now.
  double next(const std::vector<PatternRange>& levels, std::size_t begun) {
    double rest = 0.0;
    for (std::size_t level = begun; level < levels.size(); ++level) rest += levels[level].likely;
    double own = levels[begun - 1].likely, share = left_ * own / std::max(1.0, own + rest);
    left_ -= share;
    return share;
  }

 private:
  double left_ = 1.0;
};

/// Divides one level. False if it was dropped on an alarm; the tree is as it was.
bool divided(Tree& tree, int level, const Schedule& plan, Watch& watch, const References& references,
             const Scheme& scheme, Progress& part, const PatternsThrough& through) {
  std::vector<ColourBlock> rounding = tree.rounding;
  std::vector<LeafNoise> leafNoise = tree.leafNoise;
  std::vector<std::uint8_t> unknown = tree.unknown;
  try {
    watch.check(part);
    divide(tree, level, plan, watch, references, scheme, part, through);
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
              Progress& progress, const GrowthWatcher& watcher) {
  bool kept = false;
  std::vector<int> patterns;
  Shares shares;
  int last = tree.layout.levels() - 1;
  for (int level = tree.layout.levels() - 1; level >= 0; --level) {
    plantRoots(tree, level, references, scheme);
    if (level == 0) continue;
    if (tree.active.blocks() == 0) {
      patterns.push_back(0);
      continue;
    }
    bool goOn = !rootsOnly && !kept && !progress.stopAndKeep();
    if (goOn) {
      Schedule plan = scheduleOf(tree, level);
      patterns.push_back(patternsOf(plan, scheme, tree.layout, level));
      if (watcher.levelBegins) watcher.levelBegins(patterns);
      double share = shares.next(levelPatterns(tree.layout.projectors(), scheme.lights.size(), patterns),
                                 patterns.size());
      Progress part = progress.part(
          share, fmt::format("level {} of {}: {} patterns", last - level + 1, last, patterns.back()));
      if (divided(tree, level, plan, watch, references, scheme, part, watcher.patternsThrough)) continue;
    }
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
