// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/transport/code_lanes.h"
#include "relucent/transport/node_layout.h"

namespace relucent::transport {
namespace {

constexpr std::size_t rowsOfATask = 16;

using detail::Floats;
using detail::load;

void store(float* to, const Floats& values) {
  std::memcpy(to, &values, sizeof values);
}

/// Where the blocks of one level lie along one side of a projector: all are `side` pixels long but the last,
/// which the border may cut off.
class Cuts {
 public:
  Cuts(int pixels, int level, int blocks) : pixels_(pixels), side_(1 << level), blocks_(blocks) {}
  int blocks() const { return blocks_; }
  /// How many of the first blocks have two children of full length.
  int whole() const { return pixels_ / side_; }
  int length(int block) const { return std::min(side_, pixels_ - block * side_); }
  /// Of the block's two halves. The second is 0 where the border leaves nothing of it.
  int firstHalf(int block) const { return std::min(side_ / 2, length(block)); }
  int secondHalf(int block) const { return length(block) - firstHalf(block); }

 private:
  int pixels_, side_, blocks_;
};

/// Pixels of a node's children: weighting by them keeps every pixel's say equal however its block is cut.
struct ChildWeights {
  float upperLeft, upperRight, lowerLeft, lowerRight, sum;

  ChildWeights(const Cuts& columns, const Cuts& rows, int x, int y)
      : upperLeft(static_cast<float>(columns.firstHalf(x) * rows.firstHalf(y))),
        upperRight(static_cast<float>(columns.secondHalf(x) * rows.firstHalf(y))),
        lowerLeft(static_cast<float>(columns.firstHalf(x) * rows.secondHalf(y))),
        lowerRight(static_cast<float>(columns.secondHalf(x) * rows.secondHalf(y))),
        sum(static_cast<float>(columns.length(x) * rows.length(y))) {}
};

/// One row of a level's means from the two rows below it; `lower` is `upper` where there is no second, and
/// then its weights are 0.
void meansOfRow(const Cuts& columns, const Cuts& rows, int y, const float* upper, const float* lower,
                float* out) {
  const bool wholeRow = y < rows.whole();
  const int whole = wholeRow ? columns.whole() : 0;
  int x = 0;
  // Four values at a time, of which the next node writes the last again.
  for (; x + 1 < whole; ++x, upper += 6, lower += 6, out += 3)
    store(out, 0.25f * ((load(upper) + load(upper + 3)) + (load(lower) + load(lower + 3))));
  for (; x < whole; ++x, upper += 6, lower += 6, out += 3)
    for (int c = 0; c < 3; ++c) out[c] = 0.25f * ((upper[c] + upper[c + 3]) + (lower[c] + lower[c + 3]));

  for (; x < columns.blocks(); ++x, upper += 6, lower += 6, out += 3) {
    ChildWeights weights(columns, rows, x, y);
    const int right = columns.secondHalf(x) > 0 ? 3 : 0;
    for (int c = 0; c < 3; ++c)
      out[c] = (weights.upperLeft * upper[c] + weights.upperRight * upper[c + right] +
                weights.lowerLeft * lower[c] + weights.lowerRight * lower[c + right]) /
               weights.sum;
  }
}

/// The adjoint: a row of a level hands what it holds to one row of children, in proportion to their pixels.
template <std::size_t floats>
void spreadRow(const Cuts& columns, const Cuts& rows, int y, bool upper, const float* from, float* to) {
  const bool wholeRow = y < rows.whole();
  const int whole = wholeRow ? columns.whole() : 0;
  int x = 0;
  if constexpr (floats == 3) {
    // Two nodes at a time: twelve values are three times four.
    for (; x + 2 <= whole; x += 2, from += 6, to += 12) {
      const Floats first = 0.25f * load(from), second = 0.25f * load(from + 2);
      store(to, load(to) + __builtin_shufflevector(first, first, 0, 1, 2, 0));
      store(to + 4, load(to + 4) + __builtin_shufflevector(first, second, 1, 2, 5, 6));
      store(to + 8, load(to + 8) + __builtin_shufflevector(second, second, 3, 1, 2, 3));
    }
  } else {
    static_assert(floats == 4);
    for (; x < whole; ++x, from += 4, to += 8) {
      const Floats share = 0.25f * load(from);
      store(to, load(to) + share);
      store(to + 4, load(to + 4) + share);
    }
  }
  for (; x < whole; ++x, from += floats, to += 2 * floats) {
    for (std::size_t c = 0; c < floats; ++c) {
      to[c] += 0.25f * from[c];
      to[c + floats] += 0.25f * from[c];
    }
  }

  for (; x < columns.blocks(); ++x, from += floats, to += 2 * floats) {
    ChildWeights weights(columns, rows, x, y);
    const float left = (upper ? weights.upperLeft : weights.lowerLeft) / weights.sum;
    const float right = (upper ? weights.upperRight : weights.lowerRight) / weights.sum;
    for (std::size_t c = 0; c < floats; ++c) {
      to[c] += left * from[c];
      if (columns.secondHalf(x) > 0) to[c + floats] += right * from[c];
    }
  }
}

}  // namespace

NodeStack NodeLayout::means(const ProjectorStack& pattern) const {
  require(pattern.size() == 3 * projectors_.count(), "a pattern of {} values for {} projector pixels",
          pattern.size(), projectors_.count());
  NodeStack values;
  values.reserve(3 * count_);
  values.assign(pattern.begin(), pattern.end());
  values.resize(3 * count_);
  fillMeans(values);
  return values;
}

/// One line of a level from the next finer one.
void NodeLayout::fillLine(std::size_t projector, int level, int line, std::span<float> values) const {
  const Size pixels = projectors_.size(projector);
  const Grid& fine = grids_[projector][static_cast<std::size_t>(level - 1)];
  const Grid& coarse = grids_[projector][static_cast<std::size_t>(level)];
  const Cuts columns(pixels.width, level, coarse.size.width);
  const Cuts rows(pixels.height, level, coarse.size.height);
  const float* upper = &values[3 * (fine.offset + indexOf(fine.size, {0, 2 * line}))];
  const float* lower =
      rows.secondHalf(line) > 0 ? upper + 3 * static_cast<std::size_t>(fine.size.width) : upper;
  meansOfRow(columns, rows, line, upper, lower,
             &values[3 * (coarse.offset + indexOf(coarse.size, {0, line}))]);
}

void NodeLayout::fillMeansFrom(int first, std::span<float> values) const {
  for (std::size_t projector = 0; projector < grids_.size(); ++projector)
    for (int level = first; level < levels(projector); ++level)
      parallelFor(0, static_cast<std::size_t>(gridSize(projector, level).height), rowsOfATask,
                  [&](std::size_t line) { fillLine(projector, level, static_cast<int>(line), values); });
}

void NodeLayout::fillMeansOfLine(std::size_t projector, int line, std::span<float> values) const {
  if (levels(projector) > 1) fillLine(projector, 1, line, values);
}

ProjectorStack NodeLayout::meansAdjoint(NodeStack nodeValues) const {
  require(nodeValues.size() == 3 * count_, "{} values for {} nodes", nodeValues.size(), count_);
  gatherMeansAdjoint(nodeValues);
  nodeValues.resize(3 * projectors_.count());
  return ProjectorStack(static_cast<Stack&&>(nodeValues));
}

/// To one line of a level from the next coarser one.
template <std::size_t floats>
void NodeLayout::spreadToLine(std::size_t projector, int level, int line, std::span<float> nodeValues) const {
  const Size pixels = projectors_.size(projector);
  const Grid& fine = grids_[projector][static_cast<std::size_t>(level)];
  const Grid& coarse = grids_[projector][static_cast<std::size_t>(level + 1)];
  const Cuts columns(pixels.width, level + 1, coarse.size.width);
  const Cuts rows(pixels.height, level + 1, coarse.size.height);
  spreadRow<floats>(columns, rows, line / 2, line % 2 == 0,
                    &nodeValues[floats * (coarse.offset + indexOf(coarse.size, {0, line / 2}))],
                    &nodeValues[floats * (fine.offset + indexOf(fine.size, {0, line}))]);
}

void NodeLayout::gatherAboveLines(std::span<float> nodeValues, std::size_t floats) const {
  const auto spread = floats == 4 ? &NodeLayout::spreadToLine<4> : &NodeLayout::spreadToLine<3>;
  for (std::size_t projector = 0; projector < grids_.size(); ++projector)
    for (int level = levels(projector) - 2; level > 0; --level)
      parallelFor(
          0, static_cast<std::size_t>(gridSize(projector, level).height), 2 * rowsOfATask,
          [&](std::size_t line) { (this->*spread)(projector, level, static_cast<int>(line), nodeValues); });
}

void NodeLayout::addToLine(std::size_t projector, int line, std::span<float> nodeValues,
                           std::size_t floats) const {
  if (levels(projector) <= 1) return;
  if (floats == 4)
    spreadToLine<4>(projector, 0, line, nodeValues);
  else
    spreadToLine<3>(projector, 0, line, nodeValues);
}

void NodeLayout::gatherMeansAdjoint(std::span<float> nodeValues) const {
  gatherAboveLines(nodeValues);
  for (std::size_t projector = 0; projector < grids_.size(); ++projector)
    parallelFor(0, static_cast<std::size_t>(projectors_.size(projector).height), 2 * rowsOfATask,
                [&](std::size_t line) { addToLine(projector, static_cast<int>(line), nodeValues); });
}

}  // namespace relucent::transport
