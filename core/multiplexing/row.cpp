// SPDX-License-Identifier: MIT
#include "relucent/multiplexing/row.h"

#include <algorithm>

namespace relucent::multiplexing {
namespace {

int levelIn(const transport::NodeLayout& layout, std::size_t projector, int level) {
  return std::min(level, layout.levels(projector) - 1);
}

}  // namespace

std::vector<Leaf> startingLeaves(const transport::NodeLayout& layout, int start, float spread) {
  std::vector<Leaf> leaves;
  auto pixels = static_cast<float>(layout.projectors().count());
  for (std::size_t projector = 0; projector < layout.projectors().devices(); ++projector) {
    int level = levelIn(layout, projector, start);
    Size grid = layout.gridSize(projector, level);
    for (int y = 0; y < grid.height; ++y)
      for (int x = 0; x < grid.width; ++x) {
        transport::Node node{static_cast<int>(projector), level, x, y};
        float share = static_cast<float>(layout.block(node).count()) / pixels;
        leaves.push_back({static_cast<std::uint32_t>(layout.index(node)), 0.0f, spread, share, spread});
      }
  }
  std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) { return a.node < b.node; });
  return leaves;
}

int startingLevel(const transport::NodeLayout& layout, int nodes) {
  for (int level = layout.levels() - 1; level > 0; --level) {
    std::size_t count = 0;
    for (std::size_t projector = 0; projector < layout.projectors().devices(); ++projector)
      count += layout.gridSize(projector, levelIn(layout, projector, level)).count();
    if (count >= static_cast<std::size_t>(nodes)) return level;
  }
  return 0;
}

}  // namespace relucent::multiplexing
