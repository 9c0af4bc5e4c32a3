// SPDX-License-Identifier: MIT
#include "relucent/acquisition/growth.h"

#include <fmt/format.h>

#include <algorithm>

#include "relucent/acquisition/forecast.h"
#include "relucent/acquisition/refinement.h"
#include "relucent/base/message.h"

namespace relucent::acquisition {
namespace {

/// The blocks of one level that matter, in colours.
Schedule scheduleOf(const Tree& tree, int level) {
  const transport::NodeLayout& layout = tree.layout;
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

/// Divides one level, unless it is interrupted: then the tree is as it was.
std::optional<sentinels::Interruption> divided(Tree& tree, const LevelPlan& plan, const TreeContext& context,
                                               Progress& part) {
  if (auto interrupted = context.watch.check(part)) return interrupted;
  std::vector<transport::ColourBlock> rounding = tree.rounding;
  std::vector<LeafNoise> leafNoise = tree.leafNoise;
  CameraMask unknown = tree.unknown;
  std::optional<sentinels::Interruption> interrupted = divide(tree, plan, context, part);
  if (interrupted) {
    tree.rounding = std::move(rounding);
    tree.leafNoise = std::move(leafNoise);
    tree.unknown = std::move(unknown);
  }
  return interrupted;
}

}  // namespace

std::optional<sentinels::Interruption> growTree(Tree& tree, const TreeContext& context, bool rootsOnly,
                                                Progress& progress) {
  std::optional<sentinels::Interruption> interrupted;
  LevelPlan plan;
  Shares shares;
  std::size_t lights = context.scheme.lights.size();
  int last = tree.layout.levels() - 1;
  for (int level = tree.layout.levels() - 1; level >= 0; --level) {
    addRoots(tree, level, context.references(), context.scheme);
    if (level == 0) continue;
    if (tree.active.blocks() == 0) {
      plan.patterns.push_back(0);
      continue;
    }
    if (!rootsOnly && !interrupted && !progress.stopAndKeep()) {
      plan.level = level;
      plan.schedule = scheduleOf(tree, level);
      plan.patterns.push_back(patternsOf(plan.schedule, context.scheme, tree.layout, level));
      context.observer.grew(plan.patterns, 0);
      double share =
          shares.next(levelPatterns(tree.layout.projectors(), lights, plan.patterns), plan.patterns.size());
      Progress part =
          progress.part(share, RELUCENT_PLURAL_MESSAGE("stage.level-of-tree", "level {} of {}: {} patterns",
                                                       "level {} of {}: {} pattern")
                                   .with(as::label(last - level + 1), as::label(last), plan.patterns.back()));
      interrupted = divided(tree, plan, context, part);
      if (!interrupted) continue;
      if (interrupted == sentinels::Interruption::beginAgain) return interrupted;
    }
    stopDividing(tree, context.references());
  }
  return interrupted;
}

CameraStack leafVarianceOf(const Tree& tree) {
  CameraStack variance(3 * tree.leafNoise.size(), 0.0f);
  for (std::size_t row = 0; row < tree.leafNoise.size(); ++row)
    for (std::size_t c = 0; c < 3; ++c)
      variance[3 * row + c] = tree.leafNoise[row].sum[c] / std::max(1.0f, tree.leafNoise[row].leaves);
  return variance;
}

}  // namespace relucent::acquisition
