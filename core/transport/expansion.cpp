// SPDX-License-Identifier: MIT
#include "transport/expansion.h"

#include <algorithm>
#include <array>

#include "base/error.h"

namespace relucent {
namespace {

constexpr std::uint64_t writtenBytesPerBlock = 40;

/// A run of `length` pixels cut into at most `samples` pieces, each known by its middle pixel.
struct Pieces {
  int length;
  int count;
  Pieces(int pixels, int samples) : length(pixels), count(std::min(pixels, samples)) {}
  int begin(int piece) const { return length * piece / count; }
  int pixels(int piece) const { return begin(piece + 1) - begin(piece); }
  int middle(int piece) const { return begin(piece) + pixels(piece) / 2; }
};

std::uint64_t expandedBlocks(const TransportMatrix& transport, int samplesPerSide) {
  const BlockSparse& leaves = transport.leaves();
  const NodeLayout& layout = transport.layout();
  std::uint64_t blocks = 0;
  for (std::size_t entry = 0; entry < leaves.blocks(); ++entry) {
    Block area = layout.block(layout.node(leaves.column(entry)));
    blocks += static_cast<std::uint64_t>(Pieces(area.x1 - area.x0, samplesPerSide).count) *
              static_cast<std::uint64_t>(Pieces(area.y1 - area.y0, samplesPerSide).count);
  }
  return blocks;
}

/// The largest power of two for which the matrix fits, or 0.
int largestSampling(const TransportMatrix& transport, std::uint64_t mostBytes) {
  int most = 1 << (transport.layout().levels() - 1);
  for (int samples = most; samples >= 1; samples /= 2)
    if (expandedBlocks(transport, samples) * writtenBytesPerBlock <= mostBytes) return samples;
  return 0;
}

}  // namespace

Expansion expandedToPixels(const TransportMatrix& transport, std::uint64_t mostBytes) {
  Expansion expansion;
  expansion.samplesPerSide = largestSampling(transport, mostBytes);
  if (expansion.samplesPerSide == 0)
    throw Error(ErrorKind::memory,
                fmt::format("the matrix would need {} MB as a file",
                            expandedBlocks(transport, 1) * writtenBytesPerBlock / 1'000'000),
                "export its leaves, which are smaller, or allow a larger file");

  const BlockSparse& leaves = transport.leaves();
  const NodeLayout& layout = transport.layout();
  const Rasters& projectors = transport.projectors();
  PixelMatrix& matrix = expansion.matrix;
  matrix.columns = projectors.count();
  std::uint64_t blocks = expandedBlocks(transport, expansion.samplesPerSide);
  matrix.column.reserve(blocks);
  matrix.values.reserve(9 * blocks);
  for (std::size_t row = 0; row < leaves.rows(); ++row) {
    for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry) {
      Node node = layout.node(leaves.column(entry));
      Block area = layout.block(node);
      auto projector = static_cast<std::size_t>(node.projector);
      Pieces across(area.x1 - area.x0, expansion.samplesPerSide);
      Pieces down(area.y1 - area.y0, expansion.samplesPerSide);
      if (across.count < across.length || down.count < down.length) ++expansion.sampledLeaves;
      ColourBlock perPixel = leaves.block(row, entry) / static_cast<float>(area.count());
      for (int y = 0; y < down.count; ++y) {
        for (int x = 0; x < across.count; ++x) {
          Pixel place{area.x0 + across.middle(x), area.y0 + down.middle(y)};
          ColourBlock value = perPixel * static_cast<float>(across.pixels(x) * down.pixels(y));
          matrix.column.push_back(static_cast<std::uint32_t>(projectors.offset(projector) +
                                                             indexOf(projectors.size(projector), place)));
          matrix.values.insert(matrix.values.end(), value.data(), value.data() + 9);
        }
      }
    }
    matrix.rowStart.push_back(matrix.column.size());
  }
  return expansion;
}

}  // namespace relucent
