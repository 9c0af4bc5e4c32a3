// SPDX-License-Identifier: MIT
#include "relucent/transport/leaf_row.h"

#include <algorithm>
#include <utility>

namespace relucent::transport {

LeafRow::LeafRow(const BlockSparse& own, const LeafGroups& groups, std::size_t row, std::size_t projectors)
    : own_(&own), row_(row), begin_(own.rowBegin(row)), columns_(own.columnsOf(row)) {
  if (groups.empty()) return;
  using Leaf = std::pair<std::uint32_t, std::array<std::int16_t, 3>>;
  std::vector<Leaf> leaves;
  auto take = [&leaves](const BlockSparse& from, std::size_t of) {
    for (std::size_t entry = from.rowBegin(of); entry < from.rowBegin(of + 1); ++entry)
      leaves.emplace_back(from.column(entry), from.factor(entry));
  };
  for (std::size_t projector = 0; projector < projectors; ++projector)
    for (std::uint32_t group = groups.groupOf(row, projector); group != LeafGroups::none;
         group = groups.parent(group))
      take(groups.leaves(), group);
  if (leaves.empty()) return;
  take(own, row);
  std::ranges::sort(leaves, {}, &Leaf::first);
  for (const auto& [column, factor] : leaves) {
    column_.push_back(column);
    factor_.push_back(factor);
  }
  columns_ = column_;
}

ColourBlock LeafRow::block(std::size_t entry) const {
  if (factor_.empty()) return own_->block(row_, begin_ + entry);
  const std::array<std::int16_t, 3>& code = factor_[entry];
  return own_->mixing(row_, own_->sharedColours()->kindOf(columns_[entry])) *
         Eigen::Vector3f(code[0], code[1], code[2]).asDiagonal();
}

BlockSize LeafRow::sizeOf(std::size_t entry) const {
  if (factor_.empty()) return own_->sizeOf(row_, begin_ + entry);
  const ColourBlock magnitudes = block(entry).cwiseAbs();
  return {magnitudes.maxCoeff(), magnitudes.sum()};
}

SharedColourRow LeafRow::shared() const {
  SharedColourRow row = own_->sharedRow(row_);
  if (factor_.empty()) return row;
  row.column = column_;
  row.factor = factor_;
  return row;
}

}  // namespace relucent::transport
