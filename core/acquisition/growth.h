// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "acquisition/refinement.h"
#include "acquisition/tree.h"
#include "sentinels/watch.h"

namespace relucent {

/// A tree of no nodes yet for the camera pixels of `rows`.
Tree plantedTree(const Rasters& projectors, const References& references,
                 const std::vector<std::uint8_t>& rows);

/// Looks on while a tree grows. Each may be empty.
struct GrowthWatcher {
  /// Before a level begins: the patterns of all levels that have begun, coarsest first.
  std::function<void(const std::vector<int>& patterns)> levelBegins;
  /// How many of the last of them are through.
  PatternsThrough patternsThrough;
};

/// Measures level after level, checking the light and the view before each. Ends early, with a valid, coarser
/// tree, where asked to stop and keep, or if `rootsOnly`.
/// Returns whether an alarm was answered by keep and stop: then the level under way was dropped.
/// Throws: Error; Cancelled; BeginAgain.
bool growTree(Tree& tree, Watch& watch, const References& references, const Scheme& scheme, bool rootsOnly,
              Progress& progress, const GrowthWatcher& watcher = {});

/// Per camera pixel and channel the mean variance of its leaves.
Stack leafVarianceOf(const Tree& tree);

}  // namespace relucent
