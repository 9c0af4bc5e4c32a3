// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "relucent/transport/column_kinds.h"

namespace relucent::transport {

/// The arrays of a BlockSparse, without owning them: `code` and `scale`, or those of shared colours.
struct BlockRows {
  const std::size_t* start = nullptr;
  const std::uint32_t* column = nullptr;
  const std::array<std::int16_t, 9>* code = nullptr;
  const float* scale = nullptr;
  std::size_t columns = 0;
  const std::array<std::int16_t, 3>* factor = nullptr;
  const float* mixing = nullptr;                // nine a kind, row-major
  std::span<const ColumnKinds::Range> kinds{};  // of columns
  std::size_t kindCount = 0;
};

/// Sums over the columns, allocated in tiles where something is added: neighbouring rows have entries in
/// neighbouring columns and a few coarse ones, so the sums of a range of rows need little memory, which stays
/// in the cache. Four floats per column: three channels and one that is never read, so that a column is one
/// vector and shares no bytes with the next.
class ColumnSums {
 public:
  static constexpr std::size_t tileColumns = 512;

  ColumnSums() = default;
  explicit ColumnSums(std::size_t columns) : tiles_((columns + tileColumns - 1) / tileColumns) {}

  /// The four sums of a column.
  float* at(std::size_t column) {
    Tile& tile = tiles_[column / tileColumns];
    if (!tile) [[unlikely]]
      makeTile(tile);
    return &tile[4 * (column % tileColumns)];
  }
  /// Null if nothing was added.
  const float* tile(std::size_t index) const { return tiles_[index].get(); }
  std::size_t tiles() const { return tiles_.size(); }

 private:
  using Tile = std::unique_ptr<float[]>;
  static void makeTile(Tile& tile);
  std::vector<Tile> tiles_;
};

/// The inner loops of the products, for one instruction set. Their results differ in rounding: fused
/// multiply-add rounds half as often.
struct BlockKernels {
  const char* instructions;
  /// y = B x for the rows [begin, end). Shapes: 3 * columns -> 3 * rows.
  void (*gather)(const BlockRows& rows, std::size_t begin, std::size_t end, const float* x, float* y);
  /// sums += B^T y for the rows [begin, end). Rows whose y is zero are skipped. Shapes: 3 * rows -> columns.
  void (*scatter)(const BlockRows& rows, std::size_t begin, std::size_t end, const float* y,
                  ColumnSums& sums);
};

/// The kernels that this processor can run, fastest last; the first runs on every processor of the
/// architecture.
std::span<const BlockKernels> blockKernels();

}  // namespace relucent::transport
