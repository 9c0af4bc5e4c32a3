// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "relucent/acquisition/schedule.h"
#include "relucent/acquisition/tree.h"
#include "relucent/acquisition/tree_context.h"

namespace relucent::acquisition {

/// What the schedule of one level costs: up to four quadrants a colour, each in every light of the scheme.
int patternsOf(const Schedule& schedule, const Scheme& scheme, const transport::NodeLayout& layout,
               int level);

/// One level of the tree that is to be measured.
struct LevelPlan {
  int level = 0;
  Schedule schedule;
  std::vector<int> patterns;  // of the levels that have begun, coarsest first, this one's last
};

/// Measures the children of all active nodes of a level. One frame lights the same quadrant of all blocks of
/// a colour; for a camera pixel i that has the block b active,
///   child = frame_i - e_i - sum over i's leaves of (value * share of the leaf's block that is lit),
/// the last term only if the scheme subtracts leaves. Then the scheme decides (scheme.h) whether children and
/// parent are reconciled, which children become active, and where the light of the others is kept; with its
/// sign, as cutting it off would add energy. An interruption leaves the pairs as they were, but `rounding`,
/// `leafNoise` and `unknown` as they are amid the level.
/// Throws: Error; Cancelled.
[[nodiscard]] std::optional<sentinels::Interruption> divide(Tree& tree, const LevelPlan& plan,
                                                            const TreeContext& context, Progress& progress);

}  // namespace relucent::acquisition
