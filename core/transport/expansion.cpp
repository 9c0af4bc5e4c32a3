// SPDX-License-Identifier: MIT
#include "relucent/transport/expansion.h"

#include <fmt/format.h>

#include <algorithm>

#include "relucent/base/message.h"
#include "relucent/base/parallel.h"
#include "relucent/base/random.h"

namespace relucent::transport {
namespace {

constexpr std::uint64_t bytesPerBlock = 9 * sizeof(float) + sizeof(std::int32_t);

/// The part [begin, end) that cell `i` of `cells` has of `length` pixels.
std::pair<int, int> cellOf(int i, int cells, int length) {
  return {length * i / cells, length * (i + 1) / cells};
}

}  // namespace

PixelExpansion::PixelExpansion(const TransportMatrix& transport, const ExpansionLimits& limits)
    : transport_(&transport), limits_(limits) {
  int largest = 1;
  for (Size size : transport.projectors().sizes()) largest = std::max({largest, size.width, size.height});
  // The largest side within the limit; a side of 1 is as many blocks as there are leaves and always taken.
  int low = 1, high = largest;
  while (low < high) {
    int middle = low + (high - low + 1) / 2;
    if (blocksAt(middle) * bytesPerBlock <= limits.bytes)
      low = middle;
    else
      high = middle - 1;
  }
  side_ = low;
  countRows();
}

std::uint64_t PixelExpansion::blocksAt(int side) const {
  const NodeLayout& layout = transport_->layout();
  std::vector<std::uint64_t> count(transport_->cameras().count());
  parallelFor(0, count.size(), 256, [&](std::size_t row) {
    const LeafRow leaves = transport_->row(row);
    for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
      Block block = layout.block(layout.node(leaves.column(entry)));
      count[row] += static_cast<std::uint64_t>(std::min(side, block.x1 - block.x0)) *
                    static_cast<std::uint64_t>(std::min(side, block.y1 - block.y0));
    }
  });
  std::uint64_t sum = 0;
  for (std::uint64_t blocks : count) sum += blocks;
  return sum;
}

void PixelExpansion::countRows() {
  const NodeLayout& layout = transport_->layout();
  const std::size_t rows = transport_->cameras().count();
  rowStart_.assign(rows + 1, 0);
  std::vector<double> all(rows), sampled(rows);
  parallelFor(0, rows, 64, [&](std::size_t row_) {
    std::vector<Entry> entries;
    row(row_, entries);
    rowStart_[row_ + 1] = entries.size();
    const LeafRow leaves = transport_->row(row_);
    for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
      Block block = layout.block(layout.node(leaves.column(entry)));
      double light = std::abs(static_cast<double>(leaves.block(entry).sum()));
      all[row_] += light;
      if (block.x1 - block.x0 > side_ || block.y1 - block.y0 > side_) sampled[row_] += light;
    }
  });
  double total = 0.0;
  for (std::size_t r = 0; r < rows; ++r) {
    rowStart_[r + 1] += rowStart_[r];
    total += all[r];
    sampledShare_ += sampled[r];
  }
  sampledShare_ = total > 0.0 ? sampledShare_ / total : 0.0;
}

void PixelExpansion::row(std::size_t row, std::vector<Entry>& entries) const {
  const NodeLayout& layout = transport_->layout();
  const LeafRow leaves = transport_->row(row);
  const Rasters& projectors = transport_->projectors();
  entries.clear();
  for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
    std::uint32_t index = leaves.column(entry);
    Node node = layout.node(index);
    auto projector = static_cast<std::size_t>(node.projector);
    Block block = layout.block(node);
    ColourBlock density = leaves.block(entry) / static_cast<float>(block.count());
    int width = block.x1 - block.x0, height = block.y1 - block.y0;
    int columns = std::min(side_, width), lines = std::min(side_, height);
    Random random{limits_.seed, row, index};
    for (int j = 0; j < lines; ++j) {
      auto [y0, y1] = cellOf(j, lines, height);
      for (int i = 0; i < columns; ++i) {
        auto [x0, x1] = cellOf(i, columns, width);
        int x = block.x0 + x0 + static_cast<int>(random.below(static_cast<std::uint64_t>(x1 - x0)));
        int y = block.y0 + y0 + static_cast<int>(random.below(static_cast<std::uint64_t>(y1 - y0)));
        std::size_t pixel = projectors.offset(projector) + indexOf(projectors.size(projector), {x, y});
        entries.push_back(
            {static_cast<std::uint32_t>(pixel), density * static_cast<float>((x1 - x0) * (y1 - y0))});
      }
    }
  }

  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.column < b.column; });
  std::size_t left = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (left > 0 && entries[left - 1].column == entries[i].column)
      entries[left - 1].value += entries[i].value;
    else
      entries[left++] = entries[i];
  }
  entries.resize(left);
}

Message PixelExpansion::summary() const {
  double gigabytes = static_cast<double>(blocks() * bytesPerBlock) / static_cast<double>(1 << 30);
  if (sampledShare_ == 0.0)
    return RELUCENT_ENGLISH_MESSAGE("transport.expanded-in-full",
                                    "Every leaf is written in full, {} connections of single pixels, {} GiB")
        .with(blocks(), as::number(gigabytes, as::decimals(2)));
  return RELUCENT_ENGLISH_MESSAGE("transport.expanded-by-samples",
                                  "Blocks of more than {} pixels are carried by {} sample pixels each, which "
                                  "hold {} % of the light; {} connections, {} GiB")
      .with(as::size(side_, side_), as::size(side_, side_), as::share(sampledShare_, as::decimals(1)),
            blocks(), as::number(gigabytes, as::decimals(2)));
}

PixelExpansion expandedToPixels(const TransportMatrix& transport, const ExpansionLimits& limits) {
  return PixelExpansion(transport, limits);
}

}  // namespace relucent::transport
