// SPDX-License-Identifier: MIT
#include "relucent/inverse/window_rows.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "relucent/base/parallel.h"

namespace relucent::inverse {
namespace {

/// A row whose near field spreads over more tiles than this carries no detail for the rest of them.
constexpr std::size_t mostTilesOfARow = 64;

/// A camera pixel that sees a tile, and how strongly.
struct Candidate {
  std::uint32_t row;
  float strength;
};

/// Tiles' candidates in one array: those of tile t are [start[t], start[t + 1]).
struct Candidates {
  std::vector<std::size_t> start;
  LargeVector<Candidate> list;
};

using Reach = std::vector<std::pair<std::uint32_t, float>>;

/// How strongly rows reach tiles, in one array: row r's are [start[r], start[r + 1]).
struct Reaches {
  std::vector<std::size_t> start;
  LargeVector<Reach::value_type> list;
};

/// How strongly one row's near field reaches each tile, those that it reaches most.
void findReach(std::size_t row, const NearField& near, const transport::NodeLayout& layout,
               const Rasters& tiles, int tileLevel, Reach& reach) {
  reach.clear();
  for (std::size_t leaf = near.start[row]; leaf < near.start[row + 1]; ++leaf) {
    transport::Node node = layout.node(near.node[leaf]);
    const NearField::Value value = near.value(row, leaf);
    float light = value[0] + value[1] + value[2];
    auto projector = static_cast<std::size_t>(node.projector);
    Size grid = tiles.size(projector);
    int finer = std::max(0, node.level - tileLevel), coarser = std::max(0, tileLevel - node.level);
    light /= static_cast<float>(std::size_t{1} << (2 * finer));
    for (int y = (node.y << finer) >> coarser; y <= (((node.y + 1) << finer) - 1) >> coarser; ++y)
      for (int x = (node.x << finer) >> coarser; x <= (((node.x + 1) << finer) - 1) >> coarser; ++x)
        if (x < grid.width && y < grid.height)
          reach.emplace_back(static_cast<std::uint32_t>(tiles.offset(projector) + indexOf(grid, {x, y})),
                             light);
  }
  std::sort(reach.begin(), reach.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < reach.size(); ++i) {
    if (kept > 0 && reach[kept - 1].first == reach[i].first)
      reach[kept - 1].second += reach[i].second;
    else
      reach[kept++] = reach[i];
  }
  reach.resize(kept);
  std::erase_if(reach, [](const auto& tile) { return !(tile.second > 0.0f); });
  if (reach.size() > mostTilesOfARow) {
    std::nth_element(reach.begin(), reach.begin() + mostTilesOfARow, reach.end(),
                     [](const auto& a, const auto& b) {
                       return a.second != b.second ? a.second > b.second : a.first < b.first;
                     });
    reach.resize(mostTilesOfARow);
  }
}

/// Of all rows. A row has far more places on the way than tiles in the end: only some rows at a time have
/// room for them.
Reaches reachesOf(const NearField& near, const transport::NodeLayout& layout, const Rasters& tiles,
                  int tileLevel) {
  constexpr std::size_t rowsAtOnce = 16384;
  const std::size_t rows = near.unmix.size();
  Reaches result;
  result.start.assign(1, 0);
  result.start.reserve(rows + 1);
  std::vector<Reach> found(std::min(rowsAtOnce, rows));
  for (std::size_t begin = 0; begin < rows; begin += rowsAtOnce) {
    const std::size_t count = std::min(rowsAtOnce, rows - begin);
    parallelFor(0, count, 256,
                [&](std::size_t i) { findReach(begin + i, near, layout, tiles, tileLevel, found[i]); });
    for (std::size_t i = 0; i < count; ++i) {
      result.list.insert(result.list.end(), found[i].begin(), found[i].end());
      result.start.push_back(result.list.size());
    }
  }
  return result;
}

/// The view by columns: for every tile the rows that reach it.
Candidates candidatesOf(const Reaches& reach, std::size_t tiles) {
  Candidates result;
  result.start.assign(tiles + 1, 0);
  for (const auto& tile : reach.list) ++result.start[tile.first + 1];
  for (std::size_t tile = 0; tile < tiles; ++tile) result.start[tile + 1] += result.start[tile];
  result.list.resize(result.start.back());
  std::vector<std::size_t> next(result.start.begin(), result.start.end() - 1);
  for (std::size_t row = 0; row + 1 < reach.start.size(); ++row)
    for (std::size_t i = reach.start[row]; i < reach.start[row + 1]; ++i)
      result.list[next[reach.list[i].first]++] = {static_cast<std::uint32_t>(row), reach.list[i].second};
  return result;
}

}  // namespace

WindowRows chooseWindowRows(const NearField& near, const transport::NodeLayout& layout, const Rasters& tiles,
                            const WindowSettings& settings) {
  int tileLevel = std::countr_zero(static_cast<unsigned>(settings.tile));
  Candidates candidates = candidatesOf(reachesOf(near, layout, tiles, tileLevel), tiles.count());

  auto most = static_cast<std::size_t>(settings.rows);
  WindowRows result;
  result.start.assign(tiles.count() + 1, 0);
  for (std::size_t tile = 0; tile < tiles.count(); ++tile)
    result.start[tile + 1] =
        result.start[tile] + std::min(most, candidates.start[tile + 1] - candidates.start[tile]);
  result.row.resize(result.start.back());
  parallelFor(0, tiles.count(), 64, [&](std::size_t tile) {
    auto first = candidates.list.begin() + static_cast<std::ptrdiff_t>(candidates.start[tile]);
    auto last = candidates.list.begin() + static_cast<std::ptrdiff_t>(candidates.start[tile + 1]);
    std::size_t count = result.start[tile + 1] - result.start[tile];
    auto chosen = first + static_cast<std::ptrdiff_t>(count);
    std::nth_element(first, chosen, last, [](const Candidate& a, const Candidate& b) {
      return a.strength != b.strength ? a.strength > b.strength : a.row < b.row;
    });
    std::uint32_t* row = result.row.data() + result.start[tile];
    for (auto candidate = first; candidate != chosen; ++candidate) *row++ = candidate->row;
    std::sort(row - count, row);
  });
  return result;
}

}  // namespace relucent::inverse
