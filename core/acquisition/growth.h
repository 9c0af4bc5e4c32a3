// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "relucent/acquisition/tree.h"
#include "relucent/acquisition/tree_context.h"

namespace relucent::acquisition {

/// Measures level after level, checking the light and the view before each. Ends early, with a valid, coarser
/// tree, where asked to stop and keep, or if `rootsOnly`. The observer is told how far it is.
/// Returns: keepAndStop if that was the answer to an alarm, and the level under way was dropped; beginAgain,
/// and the tree is of no use any more.
/// Throws: Error; Cancelled.
[[nodiscard]] std::optional<sentinels::Interruption> growTree(Tree& tree, const TreeContext& context,
                                                              bool rootsOnly, Progress& progress);

/// Per camera pixel and channel the mean variance of its leaves.
CameraStack leafVarianceOf(const Tree& tree);

}  // namespace relucent::acquisition
