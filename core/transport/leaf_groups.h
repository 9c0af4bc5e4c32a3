// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "relucent/base/raster.h"
#include "relucent/transport/block_sparse.h"

namespace relucent::transport {

/// Leaves that neighbouring camera pixels share. A group holds codes t_gj of nodes j of one projector's far
/// light; a camera pixel i sees those of its group and of all groups around it, with its own far colours:
///   T_ij = B_i,far diag(t_gj),
/// as it sees its own leaves, see BlockSparse. A pixel is in one group of each projector or in none.
/// Source: core/transport/README.md.
class LeafGroups {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  /// What a code of far light is worth, own or shared, of about all the far light of the camera pixel. Shares
  /// are around a hundredth and sum to one; where they are noise, their magnitudes sum to five at most.
  static constexpr float shareStep = 8.0f / 32767.0f;

  LeafGroups() = default;
  /// `leaves`: a row for each group, of one kind of colours, as withoutColours() has it; `parent`: the next
  /// wider group, or none; `groupOf`: [camera pixel][projector].
  /// Throws: std::logic_error unless the shapes agree and parents come first.
  LeafGroups(std::size_t projectors, BlockSparse leaves, std::vector<std::uint32_t> parent,
             std::vector<std::uint32_t> groupOf);
  /// One kind for all columns, for groups: their leaves have no colours of their own.
  static ColumnKinds withoutColours(std::size_t columns);
  /// Whether parents come before their groups and pixels are in groups that exist.
  static bool areSound(const std::vector<std::uint32_t>& parent, const std::vector<std::uint32_t>& groupOf);

  bool empty() const { return parent_.empty(); }
  std::size_t count() const { return parent_.size(); }
  const BlockSparse& leaves() const { return leaves_; }
  const std::vector<std::uint32_t>& parents() const { return parent_; }
  const std::vector<std::uint32_t>& groupsOfPixels() const { return groupOf_; }
  std::uint32_t parent(std::size_t group) const { return parent_[group]; }
  std::uint32_t groupOf(std::size_t pixel, std::size_t projector) const {
    return groupOf_[pixel * projectors_ + projector];
  }
  std::size_t bytes() const;

  /// y += what camera pixels receive through their groups, in the far colours of `own`, their own leaves.
  /// Shapes: 3 * columns -> 3 * rows.
  void addLight(const BlockSparse& own, const Stack& x, Stack& y) const;
  /// x += the adjoint of that. Same bits for every number of threads. Shapes: 3 * rows -> 3 * columns.
  void addAdjoint(const BlockSparse& own, const Stack& y, Stack& x) const;
  /// Sums of the codes of each group and those around it, for each projector channel.
  std::vector<std::array<float, 3>> sums() const;
  /// Pixels that are marked are in no group any more.  Shape: a mark for each pixel.
  LeafGroups without(const std::vector<std::uint8_t>& pixels) const;

  /// With those leaves alone that are marked.  Shape: a mark for each of leaves().
  LeafGroups filtered(const std::vector<std::uint8_t>& keep) const;
  /// How many of those that are marked camera pixels see, all pixels together.
  std::size_t seen(const std::vector<std::uint8_t>& marked) const;

  bool operator==(const LeafGroups&) const = default;

 private:
  std::size_t projectors_ = 0;
  BlockSparse leaves_;
  std::vector<std::uint32_t> parent_, groupOf_;
};

}  // namespace relucent::transport
