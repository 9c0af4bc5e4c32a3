// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relucent/base/raster.h"

namespace relucent::transport {

/// A node of a projector's mean pyramid: level 0 is the pixels, level l has blocks of 2^l x 2^l pixels,
/// clipped at the right and lower border if the size is not a power of two.
struct Node {
  int projector = 0;
  int level = 0;
  int x = 0;
  int y = 0;
  bool operator==(const Node&) const = default;
};

/// The part of a projector that a node covers, in pixels: [x0, x1) x [y0, y1).
struct Block {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int count() const { return (x1 - x0) * (y1 - y0); }
};

/// One value a colour of every node, as they are numbered by a NodeLayout.
using NodeStack = ValuesOf<float, Node>;

/// Numbers the nodes of all projectors' mean pyramids. All pixels of all projectors come first, in the
/// order of Rasters (node index of a pixel = its pixel index), then level 1 of all projectors, and so on.
/// Level l of a w x h projector has ceil(w / 2^l) x ceil(h / 2^l) nodes; the last level is one node.
class NodeLayout {
 public:
  NodeLayout() = default;
  explicit NodeLayout(Rasters projectors);

  const Rasters& projectors() const { return projectors_; }
  std::size_t count() const { return count_; }
  /// Levels of a projector's pyramid, 1 for a single pixel.
  int levels(std::size_t projector) const { return static_cast<int>(grids_[projector].size()); }
  /// The most levels of any projector.
  int levels() const;
  /// Nodes of one level.
  Size gridSize(std::size_t projector, int level) const {
    return grids_[projector][static_cast<std::size_t>(level)].size;
  }

  std::size_t index(const Node& node) const;
  Node node(std::size_t index) const;
  Block block(const Node& node) const;
  /// The node of the next coarser level that holds this one. Contract: not the last level.
  Node parent(const Node& node) const { return {node.projector, node.level + 1, node.x / 2, node.y / 2}; }
  /// Up to four nodes of the next finer level, row by row. Contract: level > 0.
  std::vector<Node> children(const Node& node) const;
  /// The node of `level` that holds a projector pixel (index over all projectors).
  Node nodeOver(std::size_t pixel, int level) const;

  /// Mean of a pattern over every node: v = A p. Each pixel of a clipped block counts once.
  /// Shapes: 3 * projectors().count() -> 3 * count().
  NodeStack means(const ProjectorStack& pattern) const;
  /// The adjoint A^T: spreads every node's value evenly over its pixels, into the given memory.
  ProjectorStack meansAdjoint(NodeStack nodeValues) const;

  /// The same in place, for loops that must not allocate: computes the values of all coarser nodes from those
  /// of the pixels, which come first; or adds the values of all nodes to the pixels, after which the coarser
  /// ones are invalid.
  /// Contract: 3 * count() values.
  void fillMeans(std::span<float> nodeValues) const { fillMeansFrom(1, nodeValues); }
  void gatherMeansAdjoint(std::span<float> nodeValues) const;

  /// Their parts, for loops that do something else with a line while it is in the cache. fillMeans() is
  /// fillMeansOfLine() for every line of level 1, then fillMeansFrom(2). gatherMeansAdjoint() is
  /// gatherAboveLines(), then addToLine() for every line of pixels. A level that a projector lacks is
  /// skipped. `floats`: 3 or 4 a node.
  void fillMeansFrom(int level, std::span<float> nodeValues) const;
  void fillMeansOfLine(std::size_t projector, int line, std::span<float> nodeValues) const;
  void gatherAboveLines(std::span<float> nodeValues, std::size_t floats = 3) const;
  void addToLine(std::size_t projector, int line, std::span<float> nodeValues, std::size_t floats = 3) const;

 private:
  friend class NodeCursor;
  struct Grid {
    Size size;
    std::size_t offset = 0;
  };
  void fillLine(std::size_t projector, int level, int line, std::span<float> nodeValues) const;
  template <std::size_t floats>
  void spreadToLine(std::size_t projector, int level, int line, std::span<float> nodeValues) const;

  Rasters projectors_;
  std::vector<std::vector<Grid>> grids_;  // [projector][level]
  std::size_t count_ = 0;
};

/// layout.node() of indices that ascend, as those of a row's leaves do: without a search, and with a division
/// only where another line begins. The layout must outlive it.
class NodeCursor {
 public:
  explicit NodeCursor(const NodeLayout& layout) : layout_(layout) {}

  /// Contract: not less than the index before, and less than layout.count().
  Node operator()(std::size_t index) {
    if (index >= gridEnd_) enterGridOf(index);
    const std::size_t within = index - lineBegin_;
    if (within < width_) return {projector_, level_, static_cast<int>(within), line_};
    enterLineOf(index);
    return {projector_, level_, static_cast<int>(index - lineBegin_), line_};
  }

 private:
  void enterGridOf(std::size_t index);
  void enterLineOf(std::size_t index) {
    // 32 bits are divided in a third of the time.
    const auto within = static_cast<std::uint32_t>(index - gridBegin_);
    line_ = static_cast<int>(within / static_cast<std::uint32_t>(width_));
    lineBegin_ = gridBegin_ + static_cast<std::size_t>(line_) * width_;
  }

  const NodeLayout& layout_;
  int projector_ = -1, level_ = 0, line_ = 0;  // before the first grid
  std::size_t gridBegin_ = 0, gridEnd_ = 0, lineBegin_ = 0, width_ = 0;
};

}  // namespace relucent::transport
