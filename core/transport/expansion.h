// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::transport {

struct ExpansionLimits {
  std::uint64_t bytes = std::uint64_t{2} << 30;  // of values and indices, 40 a block
  std::uint64_t seed = 1;                        // of the sample positions
};

/// The light transport with a column for every projector pixel. A leaf is spread evenly over its block's
/// pixels; if that exceeds the limit, a block is represented by n x n pixels, one at a random position in
/// each of n x n cells, with the value of its cell, which preserves sums.
/// n is as large as the limit allows. Rows are computed on request.
class PixelExpansion {
 public:
  struct Entry {
    std::uint32_t column;
    ColourBlock value;
  };

  /// Keeps a reference: the transport outlives it.
  explicit PixelExpansion(const TransportMatrix& transport, const ExpansionLimits& limits = {});

  const TransportMatrix& transport() const { return *transport_; }
  /// The side n; blocks up to n x n pixels are complete.
  int side() const { return side_; }
  /// Entries of a row: [rowBegin(r), rowBegin(r + 1)).
  std::uint64_t rowBegin(std::size_t row) const { return rowStart_[row]; }
  std::uint64_t blocks() const { return rowStart_.back(); }
  /// Share of all light that is represented by samples.
  double sampledShare() const { return sampledShare_; }
  /// Describes the expansion in a sentence for the user.
  Message summary() const;

  /// A row's entries, columns ascending.
  void row(std::size_t row, std::vector<Entry>& entries) const;

 private:
  std::uint64_t blocksAt(int side) const;
  void countRows();

  const TransportMatrix* transport_;
  ExpansionLimits limits_;
  int side_ = 1;
  double sampledShare_ = 0.0;
  std::vector<std::uint64_t> rowStart_;
};

PixelExpansion expandedToPixels(const TransportMatrix& transport, const ExpansionLimits& limits = {});

}  // namespace relucent::transport
