// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "relucent/base/large_vector.h"
#include "relucent/multiplexing/row.h"

namespace relucent::multiplexing {

/// The rows of all camera pixels, close together: 12 bytes a leaf, and 36 for each mixing. They lie in blocks
/// of many rows, so that leaves can be exchanged without a second copy of all, and those that are done with
/// can be let go of.
class Rows {
 public:
  /// Rows that lie in one block of memory: some 60 MB of leaves.
  static constexpr std::size_t rowsOfBlock = std::size_t{1} << 16;

  Rows() = default;
  /// Without leaves, their mixing zero. `kinds`: how many mixings each has.
  Rows(std::size_t count, std::size_t kinds);

  std::size_t size() const { return excess_.size(); }
  /// Of all rows.
  std::size_t leaves() const;
  std::span<const Leaf> leavesOf(std::size_t row) const;
  std::span<const transport::ColourBlock> mixingOf(std::size_t row) const;

  /// A row on its own, to be solved: `into` is reused.
  void read(std::size_t row, Row& into) const;
  /// What was found of it. Several rows may be written at once.  Contract: as many leaves and mixings as
  /// before.
  void write(std::size_t row, const Row& from);

  /// Exchanges the leaves of every row, whose turn comes in any order, on all cores: `change` finds a row's
  /// own. It must not look at leaves of other rows.
  using Change = std::function<void(std::size_t row, std::vector<Leaf>& leaves)>;
  void change(const Change& change);
  /// Lets go of the leaves of rows before this one, as far as whole blocks of memory go.
  void forgetBefore(std::size_t row);

 private:
  /// Leaves of row `first + i`: [start[i], start[i + 1]).
  struct Block {
    std::vector<std::size_t> start;
    LargeVector<Leaf> leaves;
  };

  std::span<Leaf> ownLeavesOf(std::size_t row);

  std::size_t kinds_ = 0;
  std::vector<Block> blocks_;
  LargeVector<transport::ColourBlock> mixing_;  // [row][kind]
  std::vector<float> excess_;
};

}  // namespace relucent::multiplexing
