// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "relucent/transport/transport_matrix.h"

namespace relucent::engine {

/// A leaf of T as read in every frame, 8 bytes: a camera pixel's factor for each projector channel of a node,
/// and the node's position in its patch's list. As four 16-bit lanes, so that one load suffices; code that
/// multiplies all lanes must multiply the fourth by zero.
struct PackedLeaf {
  std::array<std::int16_t, 3> code{};
  std::uint16_t column = 0;
};

/// A compact set of camera pixels whose leaves touch at most 65536 nodes. Nodes are numbered within the
/// patch, in ascending order of their index in the NodeLayout.
struct TransportPatch {
  std::uint32_t rowBegin = 0, rowEnd = 0;        // of PackedTransport's rows
  std::uint32_t columnBegin = 0, columnEnd = 0;  // of PackedTransport::nodes()
};

/// T for the real-time engine, in a third of the memory.
///   T_ij = B_i diag(t_ij)
/// B_i is camera pixel i's mixing (the row sum of T); the nodes that it sees differ by one factor per
/// projector channel: t_ijc = <B_ic, T_ijc> / |B_ic|^2 over the columns c, the least-squares fit. The factors
/// of a row sum to one, so the flood image is preserved. Immutable.
/// Source: core/engine/README.md.
class PackedTransport {
 public:
  PackedTransport() = default;
  /// `patchSide`: side in camera pixels of the squares that patches are made from, at most.
  /// A camera pixel that sees more than 65535 nodes keeps the brightest, scaled up to its row sum.
  PackedTransport(const transport::TransportMatrix& transport, int patchSide);

  const std::vector<TransportPatch>& patches() const { return patches_; }
  /// The camera pixel of every row.
  const std::vector<std::uint32_t>& pixels() const { return pixel_; }
  /// Leaves of row r: [leafStart()[r], leafStart()[r + 1]).
  const std::vector<std::uint32_t>& leafStart() const { return leafStart_; }
  const std::vector<PackedLeaf>& leaves() const { return leaf_; }
  /// B_i times the scale of the row's codes: 9 a row, row-major.
  const std::vector<float>& mixing() const { return mixing_; }
  /// The nodes of all patches' lists.
  const std::vector<std::uint32_t>& nodes() const { return node_; }
  /// Bytes that a product reads.
  std::size_t bytes() const;
  /// The most nodes of any patch.
  std::size_t mostColumns() const;

 private:
  std::vector<TransportPatch> patches_;
  std::vector<std::uint32_t> pixel_;
  std::vector<std::uint32_t> leafStart_{0};
  std::vector<PackedLeaf> leaf_;
  std::vector<float> mixing_;
  std::vector<std::uint32_t> node_;
};

}  // namespace relucent::engine
