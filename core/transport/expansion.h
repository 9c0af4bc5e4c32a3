// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "transport/transport_matrix.h"

namespace relucent {

/// A matrix of 3x3 blocks in single floats, compressed by rows, columns of a row in no order. For export: the
/// share that a single pixel has in light from a wide area is too small for BlockSparse's fixed point.
struct PixelMatrix {
  std::size_t columns = 0;
  std::vector<std::size_t> rowStart{0};
  std::vector<std::uint32_t> column;
  std::vector<float> values;  // nine a block, row-major
};

/// What expandedToPixels() did with light from wide areas.
struct Expansion {
  PixelMatrix matrix;               // rows = camera pixels, columns = projector pixels
  int samplesPerSide = 0;           // a block has at most this many samples squared
  std::uint64_t sampledLeaves = 0;  // leaves that stand on samples instead of all their pixels
};

/// T with a column for every projector pixel, for programs that know no pyramid. A leaf is spread evenly over
/// its block; where a block has more than n x n pixels, over n x n samples spaced evenly in it, each standing
/// for its neighbourhood, so that sums over smooth patterns and the flood image stay what they are.
/// n is the largest power of two for which the written matrix (40 bytes a block) stays below `mostBytes`.
/// Throws: Error{memory} if even n = 1 does not.
Expansion expandedToPixels(const TransportMatrix& transport, std::uint64_t mostBytes);

}  // namespace relucent
