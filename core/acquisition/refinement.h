// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "acquisition/references.h"
#include "acquisition/schedule.h"

namespace relucent {

/// The light transport as far as it is known: every camera pixel's projector pixels are covered by its
/// leaves, which are done, and its active nodes, which are to be divided.
struct Tree {
  NodeLayout layout;
  std::vector<BlockSparse> leaves;  // one matrix a level measured, all rows x all nodes, one scale a row
  BlockSparse active;               // (camera pixel, node) pairs of the level under way, with their values
  BlockSparse spread;               // their standard deviations
  // What rounding the row's leaves has left over so far, handed on to the next: many leaves below half a
  // code would otherwise all be lost.
  std::vector<ColourBlock> rounding;
  std::vector<std::uint8_t> unknown;  // per row: some light was too bright for every exposure
};

/// A tree of no nodes.
Tree emptyTree(const NodeLayout& layout, const References& references);

/// Adds the roots of the projectors whose pyramid ends at `level`: active where they matter, else leaves.
void plantRoots(Tree& tree, int level, const References& references, const AcquisitionSettings& settings);

/// Turns what is active into leaves, at the level where it stands.
void stopDividing(Tree& tree);

/// What the schedule of one level costs: up to four quadrants and three channels a colour.
int patternsOf(const Schedule& schedule, const NodeLayout& layout, int level);

/// Measures the children of all active nodes of `level`. One frame lights, in one channel, the same
/// quadrant of all blocks of a colour; for a camera pixel i that has the block b active,
///   child = frame_i - e_i - sum over i's leaves of (value * share of the leaf's block that is lit).
/// Then the four children and their parent, which was measured a level before, are reconciled by their
/// variances: sum of children = parent.
/// A child above tau_i = max(relative * F_i, noise) in any of its nine values becomes active; the others,
/// and all at level 0, become leaves with their signed value: cutting them off would add energy.
/// Throws: Error; Cancelled.
void divide(Tree& tree, int level, const Schedule& schedule, Photographer& photographer,
            const References& references, const AcquisitionSettings& settings, Progress& progress);

/// All leaves in one matrix; empties the tree.
BlockSparse harvest(Tree& tree, const References& references);

}  // namespace relucent
