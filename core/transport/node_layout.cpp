// SPDX-License-Identifier: MIT
#include "relucent/transport/node_layout.h"

#include <algorithm>

#include "relucent/base/error.h"

namespace relucent::transport {

NodeLayout::NodeLayout(Rasters projectors) : projectors_(std::move(projectors)) {
  grids_.resize(projectors_.devices());
  for (std::size_t projector = 0; projector < projectors_.devices(); ++projector) {
    Size size = projectors_.size(projector);
    grids_[projector].push_back({size, 0});
    while (size.count() > 1) {
      size = {(size.width + 1) / 2, (size.height + 1) / 2};
      grids_[projector].push_back({size, 0});
    }
  }
  for (int level = 0; level < levels(); ++level) {
    for (auto& pyramid : grids_) {
      if (level >= static_cast<int>(pyramid.size())) continue;
      Grid& grid = pyramid[static_cast<std::size_t>(level)];
      grid.offset = count_;
      count_ += grid.size.count();
    }
  }
}

int NodeLayout::levels() const {
  std::size_t most = 0;
  for (const auto& pyramid : grids_) most = std::max(most, pyramid.size());
  return static_cast<int>(most);
}

std::size_t NodeLayout::index(const Node& node) const {
  const Grid& grid = grids_[static_cast<std::size_t>(node.projector)][static_cast<std::size_t>(node.level)];
  return grid.offset + indexOf(grid.size, {node.x, node.y});
}

Node NodeLayout::node(std::size_t index) const {
  require(index < count_, "node {} of {}", index, count_);
  // Most nodes that anyone asks about are of the finest levels, and everybody asks: no call in the loop.
  for (std::size_t level = 0;; ++level) {
    for (std::size_t projector = 0; projector < grids_.size(); ++projector) {
      const std::vector<Grid>& pyramid = grids_[projector];
      if (level >= pyramid.size()) continue;
      const Grid& grid = pyramid[level];
      if (index >= grid.offset + grid.size.count()) continue;
      // 32 bits are divided in a third of the time.
      const auto within = static_cast<std::uint32_t>(index - grid.offset),
                 width = static_cast<std::uint32_t>(grid.size.width);
      return {static_cast<int>(projector), static_cast<int>(level), static_cast<int>(within % width),
              static_cast<int>(within / width)};
    }
  }
}

Block NodeLayout::block(const Node& node) const {
  Size size = projectors_.size(static_cast<std::size_t>(node.projector));
  int side = 1 << node.level;
  return {node.x * side, node.y * side, std::min((node.x + 1) * side, size.width),
          std::min((node.y + 1) * side, size.height)};
}

void NodeCursor::enterGridOf(std::size_t index) {
  require(index < layout_.count_, "node {} of {}", index, layout_.count_);
  // In the order in which they are numbered: level after level, of each all projectors.
  while (index >= gridEnd_) {
    if (++projector_ == static_cast<int>(layout_.grids_.size())) {
      projector_ = 0;
      ++level_;
    }
    const auto& pyramid = layout_.grids_[static_cast<std::size_t>(projector_)];
    if (level_ >= static_cast<int>(pyramid.size())) continue;
    const NodeLayout::Grid& grid = pyramid[static_cast<std::size_t>(level_)];
    gridBegin_ = grid.offset;
    gridEnd_ = grid.offset + grid.size.count();
    width_ = static_cast<std::size_t>(grid.size.width);
  }
  enterLineOf(index);
}

std::vector<Node> NodeLayout::children(const Node& node) const {
  require(node.level > 0, "a pixel has no children");
  Size finer = gridSize(static_cast<std::size_t>(node.projector), node.level - 1);
  std::vector<Node> children;
  for (int y = 2 * node.y; y < std::min(2 * node.y + 2, finer.height); ++y)
    for (int x = 2 * node.x; x < std::min(2 * node.x + 2, finer.width); ++x)
      children.push_back({node.projector, node.level - 1, x, y});
  return children;
}

Node NodeLayout::nodeOver(std::size_t pixel, int level) const {
  std::size_t projector = 0;
  while (projector + 1 < projectors_.devices() && pixel >= projectors_.offset(projector + 1)) ++projector;
  Pixel place = pixelAt(projectors_.size(projector), pixel - projectors_.offset(projector));
  level = std::min(level, levels(projector) - 1);
  return {static_cast<int>(projector), level, place.x >> level, place.y >> level};
}

}  // namespace relucent::transport
