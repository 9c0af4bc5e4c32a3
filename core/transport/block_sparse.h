// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "relucent/base/large_vector.h"
#include "relucent/base/raster.h"
#include "relucent/transport/column_kinds.h"

namespace relucent::transport {

struct BlockRows;

/// A 3x3 block: rows are camera channels, columns projector channels (paper eq. 2).
using ColourBlock = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;

/// What a row's blocks are compared by.
struct BlockSize {
  float largest = 0.0f;  // magnitude of the nine values
  float sum = 0.0f;      // of their magnitudes
};

/// A row whose blocks share its colours. Columns ascend.
struct SharedColourRow {
  std::vector<std::uint32_t> column;
  std::vector<std::array<std::int16_t, 3>> factor;
  std::vector<ColourBlock> mixing;  // a kind each
};

/// A sparse matrix of 3x3 blocks, compressed by rows, in one of two forms of 16-bit fixed-point values:
///   own colours,     22 bytes a block:  block = scale[row] * code,                  nine codes a block
///   shared colours,  10 bytes a block:  block = mixing[row, kind] * diag(code),     three codes a block,
/// where the columns say the kind. |code| <= 32767. Products are limited by memory bandwidth; compared with
/// single precision the first halves the traffic at an error of at most scale / 2 per value, 2e-5 of the
/// row's largest. For the second see SharedColourEncoder.
class BlockSparse {
 public:
  BlockSparse() = default;
  /// From finished arrays, none of them copied: rowStart has one more element than scale and ends at the
  /// number of blocks; columns ascend within a row; scale is the rows' quantisation step.
  /// Throws: std::logic_error unless the sizes agree.
  static BlockSparse assembled(std::size_t columns, std::vector<std::size_t> rowStart,
                               LargeVector<std::uint32_t> column,
                               LargeVector<std::array<std::int16_t, 9>> code, std::vector<float> scale);

  std::size_t rows() const { return rowStart_.size() - 1; }
  std::size_t columns() const { return columns_; }
  std::size_t blocks() const { return column_.size(); }
  std::size_t bytes() const;
  /// Of one block more.
  std::size_t bytesOfBlock() const;

  /// Entries of a row: [rowBegin(r), rowBegin(r + 1)), columns ascending.
  std::size_t rowBegin(std::size_t row) const { return rowStart_[row]; }
  std::uint32_t column(std::size_t entry) const { return column_[entry]; }
  std::span<const std::uint32_t> columnsOf(std::size_t row) const {
    return {column_.data() + rowStart_[row], rowStart_[row + 1] - rowStart_[row]};
  }
  /// What a value of a block is rounded to at most. Finite if all of the row is.
  float scale(std::size_t row) const { return scale_[row]; }
  ColourBlock block(std::size_t row, std::size_t entry) const;
  BlockSize sizeOf(std::size_t row, std::size_t entry) const;

  /// Null where every block has colours of its own.
  const ColumnKinds* sharedColours() const { return kinds_.count > 0 ? &kinds_ : nullptr; }
  /// Contract: blocks have colours of their own.
  const std::array<std::int16_t, 9>& code(std::size_t entry) const { return code_[entry]; }
  /// Contract: colours are shared.
  const std::array<std::int16_t, 3>& factor(std::size_t entry) const { return factor_[entry]; }
  const ColourBlock& mixing(std::size_t row, std::size_t kind) const {
    return mixing_[row * kinds_.count + kind];
  }
  SharedColourRow sharedRow(std::size_t row) const;

  /// The arrays themselves, for block_kernels.h; valid as long as this matrix.
  BlockRows view() const;

  /// y = B x. Shapes: 3 * columns() -> 3 * rows().
  Stack multiply(const Stack& x) const;
  /// x = B^T y. Rows whose y is zero are skipped, so a matrix that is stored transposed multiplies mostly
  /// dark patterns in time proportional to the lit part. Same bits for every number of threads. Shapes: 3 *
  /// rows() -> 3 * columns().
  Stack multiplyTransposed(const Stack& y) const;

  /// The transposed matrix: block (r, c) becomes its transpose at (c, r).
  BlockSparse transposed() const;
  /// Row r times the factor of each camera channel: block(r) <- diag(factor[3r..3r+2]) block(r).
  BlockSparse withRowsScaled(const Stack& factor) const;
  /// Every block times factor(row, kind of its column), value by value. Called for each row and kind, from
  /// several threads. Contract: of shared colours, all columns of one of their kinds are of one of `kinds`'s
  /// that have the same factor.
  using BlockFactor = std::function<ColourBlock(std::size_t row, std::size_t kind)>;
  BlockSparse withBlocksScaled(const ColumnKinds& kinds, const BlockFactor& factor) const&;
  /// The same in place.
  BlockSparse withBlocksScaled(const ColumnKinds& kinds, const BlockFactor& factor) &&;
  /// Only the entries that are marked.  Shape: blocks().
  /// Throws: std::logic_error if the shape differs.
  BlockSparse filtered(const std::vector<std::uint8_t>& keep) const;
  /// Only the entries for which keep(row, entry) is true; it is called once per entry, on all cores.
  BlockSparse filtered(const std::function<bool(std::size_t row, std::size_t entry)>& keep) const;

  bool operator==(const BlockSparse&) const = default;

 private:
  friend class BlockSparseBuilder;
  friend class BlockSparseWriter;
  friend class SharedColourWriter;
  friend class TransportFile;
  /// scale() of a row with these colours: the sum of all magnitudes.
  static float stepOf(std::span<const ColourBlock> mixing);
  void scaleBlocks(const ColumnKinds& kinds, const BlockFactor& factor);
  /// First row of a part, when the rows are divided into parts with equal numbers of blocks.
  std::size_t rowAtShare(std::size_t part) const;

  std::size_t columns_ = 0;
  std::vector<std::size_t> rowStart_{0};
  LargeVector<std::uint32_t> column_;
  std::vector<float> scale_;
  LargeVector<std::array<std::int16_t, 9>> code_;  // own colours
  ColumnKinds kinds_;                              // shared colours, and ...
  LargeVector<std::array<std::int16_t, 3>> factor_;
  LargeVector<ColourBlock> mixing_;  // [row][kind]
};

/// Collects blocks in any order and sorts them into a BlockSparse. Blocks at the same position are added.
class BlockSparseBuilder {
 public:
  /// `fullScale[r]`: the largest magnitude that row r will hold; larger values saturate.
  BlockSparseBuilder(std::size_t columns, std::vector<float> fullScale);

  void add(std::size_t row, std::size_t column, const ColourBlock& block);
  std::size_t blocks() const { return entries_.size(); }
  /// Not thread-safe; empties the builder.
  BlockSparse build();

 private:
  struct Entry {
    std::uint32_t row;
    std::uint32_t column;
    std::array<std::int16_t, 9> code;
  };
  std::size_t columns_;
  std::vector<float> scale_;
  LargeVector<Entry> entries_;
};

/// Writes a BlockSparse row by row from codes that are already scaled per row, without a second copy, which
/// would be a gigabyte at full scale.
class BlockSparseWriter {
 public:
  using Code = std::array<std::int16_t, 9>;

  /// `fullScale` as for BlockSparseBuilder; `blocks`: the expected number, to reserve the memory once.
  BlockSparseWriter(std::size_t columns, std::vector<float> fullScale, std::size_t blocks);

  /// A block of the current row, columns in any order. Zeros are left out.
  void add(std::size_t column, const Code& code);
  void endRow();
  /// Contract: every row has been ended.
  BlockSparse build();

 private:
  BlockSparse result_;
};

/// A block as codes on a row's scale (fullScale / 32767), saturating.
BlockSparseWriter::Code codeOf(const ColourBlock& block, float scale);

}  // namespace relucent::transport
