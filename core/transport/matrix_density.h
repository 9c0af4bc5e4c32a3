// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "relucent/transport/transport_matrix.h"

namespace relucent::transport {

/// A rectangle of T over single pixels: rows of all cameras, columns of all projectors, [first, end).
struct MatrixPart {
  std::size_t firstRow = 0, endRow = 0;
  std::size_t firstColumn = 0, endColumn = 0;

  std::size_t rows() const { return endRow - firstRow; }
  std::size_t columns() const { return endColumn - firstColumn; }
  bool operator==(const MatrixPart&) const = default;
};

/// Sums over the cells of a grid on a part of T: cell (x, y) holds the columns
/// [firstColumn + columns x / width, firstColumn + columns (x + 1) / width), rounded down, and rows likewise.
struct MatrixDensity {
  MatrixPart part;
  Size cells;
  std::vector<float> sums;  // one a cell, row by row

  /// Entries of T in a cell.
  std::size_t entries(Pixel cell) const;
  /// Sums by entries: one scale for every magnification.
  std::vector<float> means() const;
  /// The cell that holds an entry of T. Contract: it lies in the part.
  Pixel cellOf(std::size_t row, std::size_t column) const;
};

/// Pictures of T at any scale, from the whole matrix to single entries, without expanding its leaves.
/// Prepared once; may be used from any thread. A leaf's light is spread evenly over the columns of its block:
///   sum of a cell = sum over its rows i and columns j of l(T_ij),  T_ij = sum of leaves over j / their
///   pixels,
/// l: luminance of the camera pixel's signal from the projector pixel at white (ITU-R BT.709).
/// A picture costs one pass over the leaves of its rows; where columns of cells are whole lines of one
/// projector, coarse blocks need not be spread line by line.
class MatrixPictures {
 public:
  enum class Of {
    light,       // luminance
    connections  // stored ones: 1 for each leaf over an entry
  };

  /// `cut`: leaves that it would drop are left out.  Throws: Error{usage} for wrong settings.
  explicit MatrixPictures(std::shared_ptr<const TransportMatrix> transport,
                          const ThresholdSettings& cut = {});

  const TransportMatrix& transport() const { return *transport_; }
  MatrixPart whole() const;
  /// Same bits for every number of threads.  `step`: only every so many rows of a cell are summed, beginning
  /// with its first, as an estimate that is about as many times faster.
  /// Contract: the part lies in whole(); each cell has at least one row and one column; the step is positive.
  MatrixDensity density(const MatrixPart& part, Size cells, Of of = Of::light, std::size_t step = 1) const;

 private:
  /// A coarse node's block, and where its projector's pixels begin.
  struct Area {
    Block block;
    std::size_t offset = 0, width = 0;
  };
  struct Scratch;
  struct Lines;
  class RowOfCells;
  std::optional<Lines> wholeLines(const MatrixPart& part, int cells) const;

  std::shared_ptr<const TransportMatrix> transport_;
  std::vector<Area> areas_;    // of the nodes behind the pixels
  std::vector<float> limits_;  // a row's least strength; empty: none
};

}  // namespace relucent::transport
