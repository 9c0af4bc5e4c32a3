// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "acquisition/schedule.h"
#include "acquisition/tree.h"
#include "sentinels/watch.h"

namespace relucent {

/// What the schedule of one level costs: up to four quadrants a colour, each in every light of the scheme.
int patternsOf(const Schedule& schedule, const Scheme& scheme, const NodeLayout& layout, int level);

/// Told after each pattern of a level: how many are through.
using PatternsThrough = std::function<void(int patterns)>;

/// Measures the children of all active nodes of `level`. One frame lights the same quadrant of all blocks of
/// a colour; for a camera pixel i that has the block b active,
///   child = frame_i - e_i - sum over i's leaves of (value * share of the leaf's block that is lit),
/// the last term only if the scheme subtracts leaves. Then the scheme decides (scheme.h) whether children and
/// parent are reconciled, which children become active, and where the light of the others is kept; with its
/// sign, as cutting it off would add energy.
/// Throws: Error; Cancelled.
void divide(Tree& tree, int level, const Schedule& schedule, Watch& watch, const References& references,
            const Scheme& scheme, Progress& progress, const PatternsThrough& through = {});

}  // namespace relucent
