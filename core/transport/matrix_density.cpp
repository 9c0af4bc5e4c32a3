// SPDX-License-Identifier: MIT
#include "relucent/transport/matrix_density.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/image/colour.h"

namespace relucent::transport {
namespace {

/// Where the k-th of `count` pieces of `length` begins.
std::size_t pieceBegin(std::size_t length, int count, std::size_t k) {
  return length * k / static_cast<std::size_t>(count);
}

/// The piece that holds a place.
std::size_t pieceAt(std::size_t length, int count, std::size_t place) {
  auto pieces = static_cast<std::size_t>(count);
  std::size_t piece = place * pieces / length;
  while (piece + 1 < pieces && pieceBegin(length, count, piece + 1) <= place) ++piece;
  return piece;
}

/// Luminance of what a block lets through of white.
float blockLuminance(const ColourBlock& block) {
  const Eigen::Vector3f white = block.rowwise().sum();
  return image::luminanceOf(white[0], white[1], white[2]);
}

}  // namespace

std::size_t MatrixDensity::entries(Pixel cell) const {
  auto length = [](std::size_t whole, int count, int k) {
    return pieceBegin(whole, count, static_cast<std::size_t>(k) + 1) -
           pieceBegin(whole, count, static_cast<std::size_t>(k));
  };
  return length(part.rows(), cells.height, cell.y) * length(part.columns(), cells.width, cell.x);
}

std::vector<float> MatrixDensity::means() const {
  std::vector<float> means(sums.size());
  std::vector<std::size_t> columns(static_cast<std::size_t>(cells.width));
  for (std::size_t x = 0; x < columns.size(); ++x)
    columns[x] = pieceBegin(part.columns(), cells.width, x + 1) - pieceBegin(part.columns(), cells.width, x);
  for (int y = 0; y < cells.height; ++y) {
    auto line = static_cast<std::size_t>(y);
    std::size_t rows =
        pieceBegin(part.rows(), cells.height, line + 1) - pieceBegin(part.rows(), cells.height, line);
    for (std::size_t x = 0; x < columns.size(); ++x) {
      std::size_t at = line * columns.size() + x;
      means[at] = sums[at] / static_cast<float>(rows * columns[x]);
    }
  }
  return means;
}

Pixel MatrixDensity::cellOf(std::size_t row, std::size_t column) const {
  require(row >= part.firstRow && row < part.endRow, "row {} of {} to {}", row, part.firstRow, part.endRow);
  require(column >= part.firstColumn && column < part.endColumn, "column {} of {} to {}", column,
          part.firstColumn, part.endColumn);
  return {static_cast<int>(pieceAt(part.columns(), cells.width, column - part.firstColumn)),
          static_cast<int>(pieceAt(part.rows(), cells.height, row - part.firstRow))};
}

/// What one thread needs for one row of cells. Coarse nodes are summed over the row's camera pixels first:
/// neighbours see the same ones, and spreading a block over its cells is what takes time.
struct MatrixPictures::Scratch {
  std::vector<float> coarse;           // sums of the nodes behind the pixels; zero between two rows of cells
  std::vector<std::uint32_t> touched;  // of those
};

/// Columns of cells that are whole lines of one projector's picture: then a block is one interval of lines,
/// and its sides are all that has to be noted.
struct MatrixPictures::Lines {
  std::size_t offset = 0, first = 0, count = 0, perCell = 1;
};

class MatrixPictures::RowOfCells {
 public:
  RowOfCells(const MatrixPictures& pictures, const MatrixPart& part, const std::vector<std::uint32_t>& cellOf,
             const std::optional<Lines>& lines, std::size_t cells, Scratch& scratch)
      : pictures_(pictures),
        part_(part),
        cellOf_(cellOf),
        lines_(lines),
        sums_(cells, 0.0),
        steps_(lines ? lines->count + 1 : 0, 0.0),
        scratch_(scratch) {}

  void add(std::size_t row, Of of) {
    const LeafRow leaves = pictures_.transport_->row(row);
    std::size_t pixels = pictures_.transport_->projectors().count();
    const std::span<const std::uint32_t> columns = leaves.columns();
    const std::uint32_t* begin = columns.data();
    const std::uint32_t* end = begin + columns.size();
    const std::uint32_t* coarse = std::lower_bound(begin, end, pixels);
    auto entryOf = [&](const std::uint32_t* at) { return static_cast<std::size_t>(at - begin); };
    float limit = pictures_.limits_.empty() ? 0.0f : pictures_.limits_[row];

    const std::uint32_t* last = std::lower_bound(begin, coarse, part_.endColumn);
    for (const std::uint32_t* at = std::lower_bound(begin, last, part_.firstColumn); at != last; ++at) {
      if (limit > 0.0f && leaves.sizeOf(entryOf(at)).largest < limit) continue;
      sums_[cellOf_[*at - part_.firstColumn]] +=
          static_cast<double>(of == Of::light ? blockLuminance(leaves.block(entryOf(at))) : 1.0f);
    }
    for (const std::uint32_t* at = coarse; at != end; ++at) {
      auto node = static_cast<std::uint32_t>(*at - pixels);
      auto count = static_cast<float>(pictures_.areas_[node].block.count());
      if (limit > 0.0f && leaves.sizeOf(entryOf(at)).largest / count < limit) continue;
      float& sum = scratch_.coarse[node];
      // One whose sum comes back to zero is listed twice; the second time there is nothing left of it.
      if (sum == 0.0f) scratch_.touched.push_back(node);
      sum += of == Of::light ? blockLuminance(leaves.block(entryOf(at))) / count : 1.0f;
    }
  }

  /// `share`: rows of the cell by rows that were added.
  void finish(float* values, double share) {
    for (std::uint32_t node : scratch_.touched) {
      double value = static_cast<double>(std::exchange(scratch_.coarse[node], 0.0f));
      if (lines_)
        step(pictures_.areas_[node], value);
      else
        spread(pictures_.areas_[node], value);
    }
    double light = 0.0;
    for (std::size_t line = 0; lines_ && line < lines_->count; ++line) {
      light += steps_[line];
      sums_[line / lines_->perCell] += light;
    }
    scratch_.touched.clear();
    for (std::size_t x = 0; x < sums_.size(); ++x) values[x] = static_cast<float>(share * sums_[x]);
  }

 private:
  /// Notes where the lines of a block begin and end.
  void step(const Area& area, double value) {
    if (area.offset != lines_->offset) return;
    auto place = [&](int y) {
      auto line = static_cast<std::size_t>(y);
      return line <= lines_->first ? 0 : std::min(line - lines_->first, lines_->count);
    };
    double ofLine = value * (area.block.x1 - area.block.x0);
    steps_[place(area.block.y0)] += ofLine;
    steps_[place(area.block.y1)] -= ofLine;
  }

  /// `value`: of each pixel of the block.
  void spread(const Area& area, double value) {
    auto lineOf = [&](std::size_t column) {
      return column <= area.offset ? 0 : (column - area.offset) / area.width;
    };
    auto first = std::max(static_cast<std::size_t>(area.block.y0), lineOf(part_.firstColumn));
    auto last = std::min(static_cast<std::size_t>(area.block.y1), lineOf(part_.endColumn) + 1);
    for (std::size_t y = first; y < last; ++y) {
      std::size_t line = area.offset + y * area.width;
      std::size_t begin = std::max(line + static_cast<std::size_t>(area.block.x0), part_.firstColumn);
      std::size_t end = std::min(line + static_cast<std::size_t>(area.block.x1), part_.endColumn);
      while (begin < end) {
        std::uint32_t cell = cellOf_[begin - part_.firstColumn];
        std::size_t next =
            std::min(end, part_.firstColumn + pieceBegin(part_.columns(), static_cast<int>(sums_.size()),
                                                         static_cast<std::size_t>(cell) + 1));
        sums_[cell] += value * static_cast<double>(next - begin);
        begin = next;
      }
    }
  }

  const MatrixPictures& pictures_;
  const MatrixPart& part_;
  const std::vector<std::uint32_t>& cellOf_;  // of each column of the part
  const std::optional<Lines>& lines_;
  std::vector<double> sums_, steps_;
  Scratch& scratch_;
};

std::optional<MatrixPictures::Lines> MatrixPictures::wholeLines(const MatrixPart& part, int cells) const {
  const Rasters& projectors = transport_->projectors();
  std::size_t device = 0;
  while (device + 1 < projectors.devices() && part.firstColumn >= projectors.offset(device + 1)) ++device;
  std::size_t offset = projectors.offset(device);
  auto width = static_cast<std::size_t>(projectors.size(device).width);
  bool inside = part.endColumn <= offset + projectors.size(device).count();
  std::size_t cell = part.columns() / static_cast<std::size_t>(cells);
  if (!inside || part.columns() % static_cast<std::size_t>(cells) != 0 || cell % width != 0 ||
      (part.firstColumn - offset) % width != 0)
    return std::nullopt;
  return Lines{offset, (part.firstColumn - offset) / width, part.columns() / width, cell / width};
}

MatrixPictures::MatrixPictures(std::shared_ptr<const TransportMatrix> transport, const ThresholdSettings& cut)
    : transport_(std::move(transport)) {
  require(transport_ != nullptr, "no light transport");
  const NodeLayout& layout = transport_->layout();
  const Rasters& projectors = layout.projectors();
  areas_.resize(layout.count() - projectors.count());
  parallelFor(0, areas_.size(), 1024, [&](std::size_t i) {
    Node node = layout.node(projectors.count() + i);
    auto device = static_cast<std::size_t>(node.projector);
    areas_[i] = {layout.block(node), projectors.offset(device),
                 static_cast<std::size_t>(projectors.size(device).width)};
  });
  std::vector<float> limits = thresholdLimits(*transport_, cut);
  if (std::any_of(limits.begin(), limits.end(), [](float limit) { return limit > 0.0f; }))
    limits_ = std::move(limits);
}

MatrixPart MatrixPictures::whole() const {
  return {0, transport_->cameras().count(), 0, transport_->projectors().count()};
}

MatrixDensity MatrixPictures::density(const MatrixPart& part, Size cells, Of of, std::size_t step) const {
  MatrixPart all = whole();
  require(part.firstRow < part.endRow && part.endRow <= all.endRow, "rows {} to {} of {}", part.firstRow,
          part.endRow, all.endRow);
  require(part.firstColumn < part.endColumn && part.endColumn <= all.endColumn, "columns {} to {} of {}",
          part.firstColumn, part.endColumn, all.endColumn);
  require(!cells.empty() && static_cast<std::size_t>(cells.height) <= part.rows() &&
              static_cast<std::size_t>(cells.width) <= part.columns(),
          "{} x {} cells for {} x {} entries", cells.width, cells.height, part.columns(), part.rows());

  require(step > 0, "no step from row to row");
  MatrixDensity density{part, cells, std::vector<float>(cells.count())};
  std::vector<std::uint32_t> cellOf(part.columns());
  for (int x = 0; x < cells.width; ++x) {
    auto at = static_cast<std::size_t>(x);
    std::fill(cellOf.begin() + static_cast<std::ptrdiff_t>(pieceBegin(part.columns(), cells.width, at)),
              cellOf.begin() + static_cast<std::ptrdiff_t>(pieceBegin(part.columns(), cells.width, at + 1)),
              static_cast<std::uint32_t>(x));
  }
  std::optional<Lines> lines = wholeLines(part, cells.width);
  tbb::enumerable_thread_specific<Scratch> scratches;
  parallelFor(0, static_cast<std::size_t>(cells.height), 1, [&](std::size_t y) {
    Scratch& scratch = scratches.local();
    scratch.coarse.resize(areas_.size(), 0.0f);
    RowOfCells line(*this, part, cellOf, lines, static_cast<std::size_t>(cells.width), scratch);
    std::size_t begin = part.firstRow + pieceBegin(part.rows(), cells.height, y);
    std::size_t end = part.firstRow + pieceBegin(part.rows(), cells.height, y + 1);
    for (std::size_t row = begin; row < end; row += step) line.add(row, of);
    std::size_t added = (end - begin + step - 1) / step;
    line.finish(density.sums.data() + y * static_cast<std::size_t>(cells.width),
                static_cast<double>(end - begin) / static_cast<double>(added));
  });
  return density;
}

}  // namespace relucent::transport
