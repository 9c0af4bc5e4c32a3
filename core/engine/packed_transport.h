// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "relucent/transport/transport_matrix.h"

namespace relucent::engine {

/// A leaf of T as read in every frame, 8 bytes: a factor for each projector channel of a node, and the node's
/// position in its patch's list. As four 16-bit lanes, so that one load suffices; code that multiplies all
/// lanes must multiply the fourth by zero.
struct PackedLeaf {
  std::array<std::int16_t, 3> code{};
  std::uint16_t column = 0;
};

/// Leaves are read four at a time. What fills up a run has codes 0 and the columns behind those of its patch.
inline constexpr std::size_t leavesTogether = 4;

/// Leaves that neighbouring camera pixels share: a square of at most 8x8 of them.
struct PackedGroup {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t leafBegin = 0, leafEnd = 0;
  std::uint32_t parent = none;             // the group around it, which comes before it
  float scale = 0.0f;                      // of its codes
  std::uint32_t rowBegin = 0, rowEnd = 0;  // its camera pixels
};

/// A camera pixel's own leaves, and what it makes of the light of its group.
struct PackedRow {
  std::array<float, 9> own{}, shared{};  // mixings, row-major; `own` times the scale of the codes
  float nothing = 0.0f;                  // read behind the last row of `shared`
  std::uint32_t pixel = 0;
  std::uint32_t leafBegin = 0, leafEnd = 0;
  std::uint32_t group = PackedGroup::none;
};

/// At most 8x8 camera pixels with the groups that they are in.
struct PackedSquare {
  std::uint32_t groupBegin = 0, groupEnd = 0;  // of PackedTransport::groups()
  std::uint32_t rowBegin = 0, rowEnd = 0;      // of PackedTransport::rows()
};

/// A compact set of camera pixels whose leaves touch at most 65535 nodes. Nodes are numbered within the
/// patch, in ascending order of their index in the NodeLayout.
struct TransportPatch {
  std::uint32_t squareBegin = 0, squareEnd = 0;  // of PackedTransport::squares()
  std::uint32_t groupBegin = 0, groupEnd = 0;    // of all its squares
  std::uint32_t rowBegin = 0, rowEnd = 0;
  std::uint32_t columnBegin = 0, columnEnd = 0;  // of PackedTransport::nodes()
};

struct PackingSettings {
  int patchSide = 64;  // of the squares that patches are made from, camera pixels, at most
  // What a leaf may be off by, as a share of the camera pixel's light, so that others need not be kept; 0:
  // nothing.
  float tolerance = 0.005f;
};

/// T for the real-time engine, in a third of its leaves.
///   (T p)_i = N_i sum_near t_ij v_j + F_i (sum_far t_ij v_j + light of i's group),    v = node values of p
///   light of a group = sum t_gj v_j + light of its parent
/// N_i and F_i are the mixings of camera pixel i's near and far light, see rowLight(); far light arrives
/// alike at neighbouring camera pixels, see shareLight(). Leaves are within `tolerance`; the sums of rows are
/// T's, so that the flood image is preserved. Immutable. Source: core/engine/README.md.
class PackedTransport {
 public:
  PackedTransport() = default;
  /// A camera pixel that sees more than 65535 nodes keeps the brightest, scaled up to its row sum.
  PackedTransport(const transport::TransportMatrix& transport, const PackingSettings& settings);

  const std::vector<TransportPatch>& patches() const { return patches_; }
  const std::vector<PackedSquare>& squares() const { return square_; }
  const std::vector<PackedRow>& rows() const { return row_; }
  const std::vector<PackedGroup>& groups() const { return group_; }
  const std::vector<PackedLeaf>& leaves() const { return leaf_; }
  /// The nodes of all patches' lists.
  const std::vector<std::uint32_t>& nodes() const { return node_; }
  /// Bytes that a product reads.
  std::size_t bytes() const;
  /// The most nodes of any patch.
  std::size_t mostColumns() const;

 private:
  struct Patch;
  void append(const Patch& patch);

  std::vector<TransportPatch> patches_;
  std::vector<PackedSquare> square_;
  std::vector<PackedRow> row_;
  std::vector<PackedGroup> group_;
  std::vector<PackedLeaf> leaf_;
  std::vector<std::uint32_t> node_;
};

}  // namespace relucent::engine
