// SPDX-License-Identifier: MIT
#pragma once

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
  BlockSize sizeOf(std::size_t entry) const;
  /// Contract: colours are shared. The row as it is, groups and all.
  SharedColourRow shared() const;

 private:
  const BlockSparse* own_;
  std::size_t row_, begin_;
  std::span<const std::uint32_t> columns_;
  // Where groups have leaves: all of them.
  std::vector<std::uint32_t> column_;
  std::vector<std::array<std::int16_t, 3>> factor_;
};

}  // namespace relucent::transport
