// SPDX-License-Identifier: MIT
#include "relucent/acquisition/frames.h"

#include <algorithm>
#include <numeric>

#include "relucent/acquisition/children.h"
#include "relucent/base/error.h"

namespace relucent::acquisition {

bool childOf(const transport::NodeLayout& layout, const transport::Node& parent, int quadrant,
             transport::Node& child) {
  child = {parent.projector, parent.level - 1, 2 * parent.x + quadrant % 2, 2 * parent.y + quadrant / 2};
  Size grid = layout.gridSize(static_cast<std::size_t>(parent.projector), child.level);
  return child.x < grid.width && child.y < grid.height;
}

PairsByColour::PairsByColour(const transport::BlockSparse& active, const Schedule& schedule)
    : start(schedule.colours + 1, 0) {
  for (std::size_t pair = 0; pair < active.blocks(); ++pair)
    ++start[schedule.colour(active.column(pair)) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  seen.resize(active.blocks());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (std::size_t row = 0; row < active.rows(); ++row)
    for (std::size_t pair = active.rowBegin(row); pair < active.rowBegin(row + 1); ++pair)
      seen[next[schedule.colour(active.column(pair))]++] = {static_cast<std::uint32_t>(row),
                                                            static_cast<std::uint32_t>(pair)};
}

std::vector<std::uint8_t> litPixels(const Schedule& schedule, const transport::NodeLayout& layout,
                                    std::uint32_t colour, int quadrant) {
  const Rasters& projectors = layout.projectors();
  std::vector<std::uint8_t> lit;
  for (std::size_t i = 0; i < schedule.colourOf.size(); ++i) {
    transport::Node child;
    if (schedule.colourOf[i] != colour ||
        !childOf(layout, layout.node(schedule.firstNode + i), quadrant, child))
      continue;
    if (lit.empty()) lit.assign(projectors.count(), 0);
    transport::Block block = layout.block(child);
    auto projector = static_cast<std::size_t>(child.projector);
    for (int y = block.y0; y < block.y1; ++y) {
      std::size_t begin = projectors.offset(projector) + indexOf(projectors.size(projector), {block.x0, y});
      std::fill_n(lit.begin() + static_cast<std::ptrdiff_t>(begin), block.x1 - block.x0, std::uint8_t{1});
    }
  }
  return lit;
}

std::vector<float> litShares(const std::vector<std::uint8_t>& lit, const transport::NodeLayout& layout) {
  ProjectorStack pattern(3 * lit.size(), 0.0f);
  for (std::size_t i = 0; i < lit.size(); ++i) pattern[3 * i] = lit[i];
  transport::NodeStack means = layout.means(pattern);
  std::vector<float> shares(layout.count());
  for (std::size_t node = 0; node < shares.size(); ++node) shares[node] = means[3 * node];
  return shares;
}

std::vector<std::uint8_t> litQuadrants(const Schedule& schedule, const transport::NodeLayout& layout,
                                       int level) {
  std::vector<std::uint8_t> used(quadrants * schedule.colours, 0);
  for (std::size_t i = 0; i < schedule.colourOf.size(); ++i) {
    if (schedule.colourOf[i] == Schedule::dark) continue;
    transport::Node node = layout.node(schedule.firstNode + i), child;
    require(node.level == level, "a schedule for level {}, not {}", node.level, level);
    for (int quadrant = 0; quadrant < quadrants; ++quadrant)
      if (childOf(layout, node, quadrant, child))
        used[quadrants * schedule.colourOf[i] + static_cast<std::size_t>(quadrant)] = 1;
  }
  return used;
}

int framesOf(const Schedule& schedule, const transport::NodeLayout& layout, int level) {
  std::vector<std::uint8_t> used = litQuadrants(schedule, layout, level);
  return static_cast<int>(std::count(used.begin(), used.end(), 1));
}

}  // namespace relucent::acquisition
