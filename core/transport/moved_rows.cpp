// SPDX-License-Identifier: MIT
#include "relucent/transport/moved_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "relucent/base/parallel.h"
#include "relucent/base/signed_codes.h"
#include "relucent/transport/shared_colours.h"

namespace relucent::transport {
namespace {

// Lines of camera pixels that wait to be written.
constexpr int linesTogether = 32;
// A leaf below this share of a row's largest is rounding, in either form of codes.
constexpr float roundingShare = 1.0f / 65534.0f;

std::array<float, 4> cubicWeights(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {static_cast<float>(0.5 * (-t + 2.0 * t2 - t3)),
          static_cast<float>(0.5 * (2.0 - 5.0 * t2 + 3.0 * t3)),
          static_cast<float>(0.5 * (t + 4.0 * t2 - 3.0 * t3)), static_cast<float>(0.5 * (t3 - t2))};
}

/// One row under way: its leaves, columns ascending.
struct Leaves {
  std::vector<std::uint32_t> column;
  std::vector<ColourBlock> block;
  float largest = 0.0f;
};

class Interpolation {
 public:
  explicit Interpolation(const TransportMatrix& transport) : transport_(transport) {}

  /// Empty: the place lies outside of the picture.
  bool at(std::size_t camera, const Eigen::Vector2d& place, Leaves& leaves) {
    const Size size = transport_.cameras().size(camera);
    leaves.column.clear();
    leaves.block.clear();
    leaves.largest = 0.0f;
    if (!(place.x() >= 0.0 && place.y() >= 0.0 && place.x() <= size.width - 1.0 &&
          place.y() <= size.height - 1.0))
      return false;
    const int left = static_cast<int>(place.x()), top = static_cast<int>(place.y());
    const std::array<float, 4> across = cubicWeights(place.x() - left), down = cubicWeights(place.y() - top);
    entries_.clear();
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) {
        const float weight = across[static_cast<std::size_t>(i)] * down[static_cast<std::size_t>(j)];
        if (weight == 0.0f) continue;
        const Pixel pixel{std::clamp(left + i - 1, 0, size.width - 1),
                          std::clamp(top + j - 1, 0, size.height - 1)};
        add(transport_.cameras().offset(camera) + indexOf(size, pixel), weight);
      }
    merge(leaves);
    return true;
  }

 private:
  struct Entry {
    std::uint32_t column;
    ColourBlock block;
  };

  void add(std::size_t row, float weight) {
    const LeafRow leaves = transport_.row(row);
    for (std::size_t entry = 0; entry < leaves.size(); ++entry)
      entries_.push_back({leaves.column(entry), weight * leaves.block(entry)});
  }

  void merge(Leaves& leaves) {
    std::ranges::stable_sort(entries_, {}, &Entry::column);
    for (const Entry& entry : entries_) {
      if (!leaves.column.empty() && leaves.column.back() == entry.column) {
        leaves.block.back() += entry.block;
        continue;
      }
      leaves.column.push_back(entry.column);
      leaves.block.push_back(entry.block);
    }
    for (const ColourBlock& block : leaves.block)
      leaves.largest = std::max(leaves.largest, block.cwiseAbs().maxCoeff());
  }

  const TransportMatrix& transport_;
  std::vector<Entry> entries_;
};

/// Rows in the form of the T that they come from.
class RowWriter {
 public:
  virtual ~RowWriter() = default;
  /// Called from several threads, for different rows of those under way.
  virtual void encode(std::size_t place, const Leaves& leaves) = 0;
  virtual void write(std::size_t place) = 0;
  virtual BlockSparse build() = 0;
};

class SharedRows : public RowWriter {
 public:
  SharedRows(const BlockSparse& like, std::size_t together)
      : kinds_(*like.sharedColours()),
        writer_(like.columns(), like.rows(), kinds_, like.blocks()),
        rows_(together) {}

  void encode(std::size_t place, const Leaves& leaves) override {
    SharedColourEncoder(kinds_).encode(leaves.column, leaves.block, rows_[place]);
  }
  void write(std::size_t place) override { writer_.add(rows_[place]); }
  BlockSparse build() override { return writer_.build(); }

 private:
  const ColumnKinds& kinds_;
  SharedColourWriter writer_;
  std::vector<SharedColourRow> rows_;
};

class OwnRows : public RowWriter {
 public:
  OwnRows(const BlockSparse& like, std::size_t together)
      : columns_(like.columns()), rowStart_{0}, rows_(together) {
    column_.reserve(like.blocks());
    code_.reserve(like.blocks());
  }

  void encode(std::size_t place, const Leaves& leaves) override {
    Row& row = rows_[place];
    row.column.clear();
    row.code.clear();
    row.scale = leaves.largest / largestCode;
    for (std::size_t i = 0; i < leaves.column.size(); ++i) {
      if (!(leaves.block[i].cwiseAbs().maxCoeff() > roundingShare * leaves.largest)) continue;
      row.column.push_back(leaves.column[i]);
      row.code.push_back(codeOf(leaves.block[i], row.scale));
    }
  }
  void write(std::size_t place) override {
    const Row& row = rows_[place];
    for (std::size_t i = 0; i < row.column.size(); ++i) {
      column_.push_back(row.column[i]);
      code_.push_back(row.code[i]);
    }
    rowStart_.push_back(column_.size());
    scale_.push_back(row.scale);
  }
  BlockSparse build() override {
    return BlockSparse::assembled(columns_, std::move(rowStart_), std::move(column_), std::move(code_),
                                  std::move(scale_));
  }

 private:
  struct Row {
    std::vector<std::uint32_t> column;
    std::vector<BlockSparseWriter::Code> code;
    float scale = 0.0f;
  };

  std::size_t columns_;
  std::vector<std::size_t> rowStart_;
  LargeVector<std::uint32_t> column_;
  LargeVector<BlockSparseWriter::Code> code_;
  std::vector<float> scale_;
  std::vector<Row> rows_;
};

void moveCamera(const TransportMatrix& transport, std::size_t camera, const FormerPlace& former,
                RowWriter& rows, CameraMask& unknown) {
  const Size size = transport.cameras().size(camera);
  const auto width = static_cast<std::size_t>(size.width);
  for (int first = 0; first < size.height; first += linesTogether) {
    const int end = std::min(first + linesTogether, size.height);
    parallelFor(static_cast<std::size_t>(first), static_cast<std::size_t>(end), 1, [&](std::size_t y) {
      Interpolation interpolation(transport);
      Leaves leaves;
      for (int x = 0; x < size.width; ++x) {
        const Pixel place{x, static_cast<int>(y)};
        if (!interpolation.at(camera, former(camera, place), leaves))
          unknown[transport.cameras().offset(camera) + indexOf(size, place)] = 1;
        rows.encode((y - static_cast<std::size_t>(first)) * width + static_cast<std::size_t>(x), leaves);
      }
    });
    for (std::size_t place = 0; place < static_cast<std::size_t>(end - first) * width; ++place)
      rows.write(place);
  }
}

}  // namespace

MovedRows movedRows(const TransportMatrix& transport, const FormerPlace& former) {
  std::size_t widest = 0;
  for (std::size_t camera = 0; camera < transport.cameras().devices(); ++camera)
    widest = std::max(widest, static_cast<std::size_t>(transport.cameras().size(camera).width));
  const std::size_t together = widest * linesTogether;
  const BlockSparse& own = transport.ownLeaves();
  MovedRows moved;
  moved.unknown.assign(transport.cameras().count(), 0);
  const auto moveAll = [&](RowWriter& rows) {
    for (std::size_t camera = 0; camera < transport.cameras().devices(); ++camera)
      moveCamera(transport, camera, former, rows, moved.unknown);
    moved.transport = TransportMatrix(transport.cameras(), transport.projectors(), rows.build());
  };
  if (own.sharedColours()) {
    SharedRows rows(own, together);
    moveAll(rows);
  } else {
    OwnRows rows(own, together);
    moveAll(rows);
  }
  return moved;
}

}  // namespace relucent::transport
