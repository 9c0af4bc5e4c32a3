// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "acquisition/tree.h"
#include "acquisition/watch.h"

namespace relucent {

/// A tree of no nodes yet for the camera pixels of `rows`.
Tree plantedTree(const Rasters& projectors, const References& references,
                 const std::vector<std::uint8_t>& rows);

/// Told before a level begins: the patterns of all levels that have begun, coarsest first.
using LevelBegins = std::function<void(const std::vector<int>& patterns)>;

/// Measures level after level, checking the light and the view before each. Ends early, with a valid, coarser
/// tree, where asked to stop and keep, or if `rootsOnly`.
/// Returns whether an alarm was answered by keep and stop: then the level under way was dropped.
/// Throws: Error; Cancelled; BeginAgain.
bool growTree(Tree& tree, Watch& watch, const References& references, const Scheme& scheme, bool rootsOnly,
              Progress& progress, const LevelBegins& levelBegins = {});

/// Per camera pixel and channel the mean variance of its leaves.
Stack leafVarianceOf(const Tree& tree);

}  // namespace relucent
