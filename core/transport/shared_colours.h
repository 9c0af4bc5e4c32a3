// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "relucent/transport/block_sparse.h"

namespace relucent::transport {

/// Blocks, being noise, whose sum is less than this share of their magnitudes have no colours in common: they
/// have those of a larger part.
inline constexpr float cancelledShare = 0.2f;

/// Finds the colours that the blocks T_j of a row share. For each kind B = sum_j T_j, and for each column k
///   t_jk = <B_k, T_jk> / |B_k|^2,      T_j ~ B diag(t_j),
/// the least-squares fit whose blocks have the same sum: T 1 is preserved. Where the T_jk of a kind, being
/// noise, cancel (cancelledShare), B_k is that of all kinds. What rounding leaves over is handed on to
/// the next block. Not thread-safe; cheap to make.  Source: core/transport/README.md.
class SharedColourEncoder {
 public:
  explicit SharedColourEncoder(const ColumnKinds& kinds) : kinds_(kinds) {}
  /// Columns ascending. Blocks that round to zero are left out.
  void encode(std::span<const std::uint32_t> columns, std::span<const ColourBlock> blocks,
              SharedColourRow& row);

 private:
  const ColumnKinds& kinds_;
  std::vector<std::uint32_t> kind_;
  std::vector<Eigen::Vector3f> factor_;
};

/// Writes a BlockSparse of shared colours row by row.
class SharedColourWriter {
 public:
  /// `blocks`: the expected number, to reserve the memory once.
  SharedColourWriter(std::size_t columns, std::size_t rows, ColumnKinds kinds, std::size_t blocks);

  /// The next row.
  void add(const SharedColourRow& row);
  /// Contract: every row has been added.
  BlockSparse build();

 private:
  std::size_t rows_;
  BlockSparse result_;
};

}  // namespace relucent::transport
