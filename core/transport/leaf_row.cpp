// SPDX-License-Identifier: MIT
#include "relucent/transport/leaf_row.h"

namespace relucent::transport {

LeafRow::LeafRow(const BlockSparse& own, const LeafGroups& groups, std::size_t row, std::size_t projectors)
    : own_(&own), row_(row), begin_(own.rowBegin(row)), columns_(own.columnsOf(row)) {
  if (groups.empty()) return;
  column_.reserve(2 * columns_.size());
  factor_.reserve(2 * columns_.size());
  // Merged from behind into what is there: rows of either are ascending.
  auto take = [this](const BlockSparse& from, std::size_t of) {
    std::size_t taken = column_.size(), place = taken + from.rowBegin(of + 1) - from.rowBegin(of);
    column_.resize(place);
    factor_.resize(place);
    for (std::size_t entry = from.rowBegin(of + 1); entry-- > from.rowBegin(of);) {
      const std::uint32_t column = from.column(entry);
      for (; taken > 0 && column_[taken - 1] > column; --taken) {
        --place;
        column_[place] = column_[taken - 1];
        factor_[place] = factor_[taken - 1];
      }
      --place;
      column_[place] = column;
      factor_[place] = from.factor(entry);
    }
  };
  for (std::size_t projector = 0; projector < projectors; ++projector)
    for (std::uint32_t group = groups.groupOf(row, projector); group != LeafGroups::none;
         group = groups.parent(group))
      take(groups.leaves(), group);
  if (column_.empty()) return;
  take(own, row);
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
