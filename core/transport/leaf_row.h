// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "relucent/transport/block_sparse.h"
#include "relucent/transport/leaf_groups.h"

namespace relucent::transport {

/// A camera pixel's leaves, its own and those of its groups, columns ascending. Valid as long as the matrix.
class LeafRow {
 public:
  /// Nothing is copied where there are no groups.
  LeafRow(const BlockSparse& own, const LeafGroups& groups, std::size_t row, std::size_t projectors);
  LeafRow(LeafRow&&) = default;
  LeafRow& operator=(LeafRow&&) = default;

  std::size_t size() const { return columns_.size(); }
  std::span<const std::uint32_t> columns() const& { return columns_; }
  std::span<const std::uint32_t> columns() && = delete;  // they go with the row
  std::uint32_t column(std::size_t entry) const { return columns_[entry]; }
  ColourBlock block(std::size_t entry) const;
  /// A leaf is colours times a factor for each projector channel, block(entry) = colours(k) diag(factor):
  /// where colours are shared, k is the leaf's kind, else the entry. Who asks for what is linear in blocks
  /// works it out for the few colours of a row.
  std::size_t colourings() const { return own_->sharedColours() ? own_->sharedColours()->count : size(); }
  ColourBlock colours(std::size_t k) const {
    return own_->sharedColours() ? own_->mixing(row_, k) : block(k);
  }
  /// Calls visit(entry, k, factor) for every entry.
  template <typename Visit>
  void eachFactor(const Visit& visit) const {
    const ColumnKinds* kinds = own_->sharedColours();
    if (!kinds) {
      for (std::size_t entry = 0; entry < size(); ++entry)
        visit(entry, entry, Eigen::Array3f(1.0f, 1.0f, 1.0f));
      return;
    }
    // Ranges of kinds ascend as columns do.
    auto range = kinds->ranges.begin();
    for (std::size_t entry = 0; entry < size(); ++entry) {
      while (range->end <= columns_[entry]) ++range;
      const std::array<std::int16_t, 3>& code =
          factor_.empty() ? own_->factor(begin_ + entry) : factor_[entry];
      visit(entry, std::size_t{range->kind}, Eigen::Array3f(code[0], code[1], code[2]));
    }
  }
  BlockSize sizeOf(std::size_t entry) const;
  /// Contract: colours are shared. The row as it is, groups and all.
  SharedColourRow shared() const;
  /// Calls visit(entry, leaf) for every entry that is not the pixel's own; `leaf` as the groups' leaves
  /// count. Contract: `groups` and `projectors` are those that the row was made with.
  template <typename Visit>
  void visitShared(const LeafGroups& groups, std::size_t projectors, Visit visit) const {
    const BlockSparse& leaves = groups.leaves();
    for (std::size_t projector = 0; !groups.empty() && projector < projectors; ++projector)
      for (std::uint32_t group = groups.groupOf(row_, projector); group != LeafGroups::none;
           group = groups.parent(group))
        for (std::size_t leaf = leaves.rowBegin(group); leaf < leaves.rowBegin(group + 1); ++leaf) {
          auto entry = static_cast<std::size_t>(std::ranges::lower_bound(column_, leaves.column(leaf)) -
                                                column_.begin());
          // The pixel may have one of its own there, too.
          while (factor_[entry] != leaves.factor(leaf)) ++entry;
          visit(entry, leaf);
        }
  }

 private:
  const BlockSparse* own_;
  std::size_t row_, begin_;
  std::span<const std::uint32_t> columns_;
  // Where groups have leaves: all of them.
  std::vector<std::uint32_t> column_;
  std::vector<std::array<std::int16_t, 3>> factor_;
};

}  // namespace relucent::transport
