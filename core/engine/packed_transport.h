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

/// Rows, and groups, are read that many at a time, side by side: the first leaves of all of them, then all
/// second ones, and so on, up to the last of the longest. What fills up the others has codes 0 and the column
/// behind those of its patch. ("SELL-C-sigma": Kreutzer et al. 2014.)
inline constexpr std::size_t rowsTogether = 4;
struct alignas(rowsTogether * sizeof(PackedLeaf)) LeavesAbreast {
  std::array<PackedLeaf, rowsTogether> of;
};

/// 3x3 mixings of rows side by side in 16 bits: mixing = scale * code.
struct alignas(16) PackedMixings {
  /// Columns, [second index][row][first index and a 0].
  std::array<std::array<std::array<std::int16_t, 4>, rowsTogether>, 3> code{};
  std::array<float, rowsTogether> scale{};

  void set(std::size_t row, const transport::ColourBlock& mixing);
  transport::ColourBlock operator[](std::size_t row) const;
};

/// Camera pixels side by side: their own leaves, and what they make of the light of their groups. Where there
/// are too few, the first one is repeated with mixings of 0, so that what it sends is nothing.
struct alignas(64) RowSlice {
  template <typename Value>
  using Each = std::array<Value, rowsTogether>;
  PackedMixings own, shared;  // `own`: of the leaves' codes
  Each<std::uint32_t> pixel{};
  std::uint32_t leafBegin = 0, length = 0;  // of PackedTransport::leaves()
  Each<std::uint8_t> group{};               // its place in the square, from 1 on; 0: none
};

/// Groups of one square side by side, all equally many groups deep.
struct GroupSlice {
  template <typename Value>
  using Each = std::array<Value, rowsTogether>;
  static constexpr std::uint8_t nobody = 1 + 1 + 4 + 16;  // a place behind all groups
  Each<float> scale{};                                    // of the codes
  std::uint32_t leafBegin = 0, length = 0;
  Each<std::uint8_t> place{}, parent{};  // places in the square, from 1 on; parent 0: none
};

/// Leaves that neighbouring camera pixels share: a square of at most 8x8 of them.
struct PackedGroup {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t parent = none;             // the group around it, which comes before it
  float scale = 0.0f;                      // of its codes
  std::uint32_t rowBegin = 0, rowEnd = 0;  // its camera pixels
  std::uint32_t slot = 0;                  // rowsTogether * its slice + its position there
};

/// A camera pixel.
struct PackedRow {
  std::uint32_t pixel = 0;
  std::uint32_t group = PackedGroup::none;
  std::uint32_t slot = 0;  // rowsTogether * its slice + its position there
};

/// At most 8x8 camera pixels with the groups that they are in.
struct PackedSquare {
  std::uint32_t groupSliceBegin = 0, groupSliceEnd = 0;  // of PackedTransport::groupSlices()
  std::uint32_t rowSliceBegin = 0, rowSliceEnd = 0;      // of PackedTransport::rowSlices()
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
  float tolerance = 0.01f;
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
  const std::vector<RowSlice>& rowSlices() const { return rowSlice_; }
  const std::vector<GroupSlice>& groupSlices() const { return groupSlice_; }
  const std::vector<LeavesAbreast>& leaves() const { return leaf_; }
  /// The nodes of all patches' lists.
  const std::vector<std::uint32_t>& nodes() const { return node_; }

  /// The same one by one, for those who read T in another order: rows are in the order of squares, and within
  /// one those of a group follow each other.
  const std::vector<PackedRow>& rows() const { return row_; }
  const std::vector<PackedGroup>& groups() const { return group_; }
  /// A row's or a group's leaves, with what fills them up.
  std::vector<PackedLeaf> leavesOf(const PackedRow& row) const;
  std::vector<PackedLeaf> leavesOf(const PackedGroup& group) const;
  /// A row's mixing of its own leaves' codes, and that of its groups' light.
  transport::ColourBlock ownMixing(const PackedRow& row) const;
  transport::ColourBlock sharedMixing(const PackedRow& row) const;

  /// Bytes that a product reads.
  std::size_t bytes() const;
  /// The most nodes of any patch.
  std::size_t mostColumns() const;

 private:
  class PatchAppender;

  std::vector<TransportPatch> patches_;
  std::vector<PackedSquare> square_;
  std::vector<RowSlice> rowSlice_;
  std::vector<GroupSlice> groupSlice_;
  std::vector<LeavesAbreast> leaf_;
  std::vector<PackedRow> row_;
  std::vector<PackedGroup> group_;
  std::vector<std::uint32_t> node_;
};

}  // namespace relucent::engine
