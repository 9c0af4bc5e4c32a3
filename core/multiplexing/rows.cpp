// SPDX-License-Identifier: MIT
#include "relucent/multiplexing/rows.h"

#include <algorithm>

#include "relucent/base/parallel.h"
#include "relucent/base/require.h"

namespace relucent::multiplexing {
namespace {

std::size_t blockOf(std::size_t row) {
  return row / Rows::rowsOfBlock;
}
std::size_t placeOf(std::size_t row) {
  return row % Rows::rowsOfBlock;
}

}  // namespace

Rows::Rows(std::size_t count, std::size_t kinds)
    : kinds_(kinds), mixing_(count * kinds, transport::ColourBlock::Zero()), excess_(count, 0.0f) {
  for (std::size_t first = 0; first < count; first += rowsOfBlock)
    blocks_.push_back({std::vector<std::size_t>(std::min(rowsOfBlock, count - first) + 1, 0), {}});
}

std::size_t Rows::leaves() const {
  std::size_t sum = 0;
  for (const Block& block : blocks_) sum += block.leaves.size();
  return sum;
}

std::span<const Leaf> Rows::leavesOf(std::size_t row) const {
  const Block& block = blocks_[blockOf(row)];
  const std::size_t begin = block.start[placeOf(row)];
  return {block.leaves.data() + begin, block.start[placeOf(row) + 1] - begin};
}

std::span<Leaf> Rows::ownLeavesOf(std::size_t row) {
  Block& block = blocks_[blockOf(row)];
  const std::size_t begin = block.start[placeOf(row)];
  return {block.leaves.data() + begin, block.start[placeOf(row) + 1] - begin};
}

std::span<const transport::ColourBlock> Rows::mixingOf(std::size_t row) const {
  return {mixing_.data() + row * kinds_, kinds_};
}

void Rows::read(std::size_t row, Row& into) const {
  const std::span<const Leaf> leaves = leavesOf(row);
  const std::span<const transport::ColourBlock> mixing = mixingOf(row);
  into.leaves.assign(leaves.begin(), leaves.end());
  into.mixing.assign(mixing.begin(), mixing.end());
  into.excess = excess_[row];
}

void Rows::write(std::size_t row, const Row& from) {
  const std::span<Leaf> leaves = ownLeavesOf(row);
  require(from.leaves.size() == leaves.size() && from.mixing.size() == kinds_,
          "a row of {} leaves and {} mixings for one of {} and {}", from.leaves.size(), from.mixing.size(),
          leaves.size(), kinds_);
  std::ranges::copy(from.leaves, leaves.begin());
  std::ranges::copy(from.mixing, mixing_.begin() + static_cast<std::ptrdiff_t>(row * kinds_));
  excess_[row] = from.excess;
}

void Rows::change(const Change& change) {
  constexpr std::size_t rowsOfTask = 256;
  std::vector<std::vector<Leaf>> changed(std::min(rowsOfBlock, size()));
  for (std::size_t number = 0; number < blocks_.size(); ++number) {
    Block& block = blocks_[number];
    const std::size_t count = block.start.size() - 1;
    parallelFor(0, count, rowsOfTask, [&](std::size_t i) {
      changed[i].clear();
      change(number * rowsOfBlock + i, changed[i]);
    });
    for (std::size_t i = 0; i < count; ++i) block.start[i + 1] = block.start[i] + changed[i].size();
    block.leaves = {};  // before the new ones are there
    block.leaves.resize(block.start.back());
    parallelFor(0, count, rowsOfTask, [&](std::size_t i) {
      std::ranges::copy(changed[i], block.leaves.begin() + static_cast<std::ptrdiff_t>(block.start[i]));
    });
  }
}

void Rows::forgetBefore(std::size_t row) {
  for (std::size_t number = 0; number < blocks_.size() && (number + 1) * rowsOfBlock <= row; ++number) {
    if (blocks_[number].leaves.empty()) continue;
    blocks_[number].leaves = {};
    std::ranges::fill(blocks_[number].start, 0);
  }
}

}  // namespace relucent::multiplexing
