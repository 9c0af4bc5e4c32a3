// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "relucent/acquisition/children.h"
#include "relucent/acquisition/scheme.h"
#include "relucent/transport/node_layout.h"

namespace relucent::acquisition {

/// Variance of a row's leaves, per camera channel: the mean over leaves and projector channels.
struct LeafNoise {
  std::array<float, 3> sum{};
  float leaves = 0.0f;

  void add(const transport::ColourBlock& variance) {
    for (std::size_t c = 0; c < 3; ++c) sum[c] += variance.row(static_cast<Eigen::Index>(c)).mean();
    leaves += 1.0f;
  }
};

/// The light transport as far as it is known: every camera pixel's projector pixels are covered by its
/// leaves, which are done, and its active nodes, which are to be divided.
struct Tree {
  transport::NodeLayout layout;
  std::vector<transport::BlockSparse>
      leaves;                     // one matrix a level measured, all rows x all nodes, one scale a row
  transport::BlockSparse active;  // (camera pixel, node) pairs of the level under way, with their values
  transport::BlockSparse spread;  // their standard deviations
  // What rounding the row's leaves has left over so far, handed on to the next: many leaves below half a
  // code would otherwise all be lost.
  std::vector<transport::ColourBlock> rounding;
  std::vector<LeafNoise> leafNoise;  // per row
  std::vector<std::uint8_t> wanted;  // per row: takes part
  CameraMask unknown;                // per row: some light was too bright for every exposure
};

/// A tree of no nodes yet for the camera pixels of `rows`.
Tree emptyTree(const photography::References& references, const std::vector<std::uint8_t>& rows);

/// Adds the roots of the projectors whose pyramid ends at `level`: active where they matter, else leaves.
void addRoots(Tree& tree, int level, const photography::References& references, const Scheme& scheme);

/// Standard deviations as codes, never zero: they stand beside an active pair's value.
transport::BlockSparseWriter::Code spreadCode(const transport::ColourBlock& variance, float scale);

/// Sorts measured children into leaves and the next level's active nodes.
void adopt(Tree& tree, const Children& children, const photography::References& references);

/// Turns what is active into leaves, at the level where it stands.
void stopDividing(Tree& tree, const photography::References& references);

/// All leaves in one matrix; they are taken out of the tree, as two of them need not fit into memory.
transport::BlockSparse takeLeaves(Tree& tree, const photography::References& references);

}  // namespace relucent::acquisition
