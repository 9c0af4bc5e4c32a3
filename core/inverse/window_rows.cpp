// SPDX-License-Identifier: MIT
#include "relucent/inverse/window_rows.h"

#include <algorithm>
#include <bit>
#include <functional>
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

/// The tiles that a leaf lies in, and its light in each.
struct Patch {
  std::size_t offset = 0;  // of the projector's tiles
  Size grid;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // both ends included, some of them beyond the grid
  float light = 0.0f;

  std::size_t tiles() const {
    return static_cast<std::size_t>(x1 - x0 + 1) * static_cast<std::size_t>(y1 - y0 + 1);
  }
  std::uint32_t tileAt(int x, int y) const {
    return static_cast<std::uint32_t>(offset + indexOf(grid, {x, y}));
  }
  /// Of a narrower leaf: leaves overlap only where one holds the other.
  bool holds(const Patch& other) const {
    return offset == other.offset && other.x0 >= x0 && other.x0 <= x1 && other.y0 >= y0 && other.y0 <= y1;
  }
};

Patch patchOf(const transport::Node& node, const NearField::Value& value, const Rasters& tiles,
              int tileLevel) {
  const auto projector = static_cast<std::size_t>(node.projector);
  const int finer = std::max(0, node.level - tileLevel), coarser = std::max(0, tileLevel - node.level);
  auto last = [&](int at) { return (((at + 1) << finer) - 1) >> coarser; };
  return {tiles.offset(projector),
          tiles.size(projector),
          (node.x << finer) >> coarser,
          (node.y << finer) >> coarser,
          last(node.x),
          last(node.y),
          (value[0] + value[1] + value[2]) / static_cast<float>(std::size_t{1} << (2 * finer))};
}

/// Finds how strongly one row's near field reaches each tile, those that it reaches most.
class ReachFinder {
 public:
  ReachFinder(const NearField& near, const transport::NodeLayout& layout, const Rasters& tiles, int tileLevel)
      : near_(near), layout_(layout), tiles_(tiles), tileLevel_(tileLevel) {}

  /// Valid until the next call.
  const Reach& of(std::size_t row) {
    reach_.clear();
    narrow_.clear();
    wide_.clear();
    transport::NodeCursor nodeAt(layout_);
    for (std::size_t leaf = near_.start[row]; leaf < near_.start[row + 1]; ++leaf) {
      const Patch patch = patchOf(nodeAt(near_.node[leaf]), near_.value(row, leaf), tiles_, tileLevel_);
      (patch.tiles() > mostTilesOfARow ? wide_ : narrow_).push_back(patch);
    }
    for (const Patch& patch : narrow_) addFirst(patch, patch.tiles());
    if (isNested())
      for (const Patch& patch : wide_) addFirst(patch, patch.tiles());
    else
      addStrongestWide();
    sum();
    keepStrongest();
    return reach_;
  }

 private:
  /// The first tiles of a patch, in their order. Returns: how many there were.
  std::size_t addFirst(const Patch& patch, std::size_t most) {
    std::size_t added = 0;
    for (int y = patch.y0; y <= std::min(patch.y1, patch.grid.height - 1); ++y)
      for (int x = patch.x0; x <= std::min(patch.x1, patch.grid.width - 1) && added < most; ++x, ++added)
        reach_.emplace_back(patch.tileAt(x, y), patch.light);
    return added;
  }

  /// Whether a wide leaf holds another leaf: trees that are divided where they need to be have such.
  bool isNested() const {
    return std::ranges::any_of(wide_, [&](const Patch& patch) {
      auto within = [&](const Patch& other) { return &other != &patch && patch.holds(other); };
      return std::ranges::any_of(narrow_, within) || std::ranges::any_of(wide_, within);
    });
  }

  /// A wide leaf's tiles are equals where nothing else is: the first can be among the strongest, and those of
  /// darker leaves cannot beside them.
  void addStrongestWide() {
    std::ranges::stable_sort(wide_, std::greater(), &Patch::light);
    std::size_t brighter = 0;
    for (std::size_t i = 0; i < wide_.size(); ++i) {
      const bool asBright = i > 0 && wide_[i].light == wide_[i - 1].light;
      if (brighter >= mostTilesOfARow && !asBright) return;
      brighter += addFirst(wide_[i], mostTilesOfARow);
    }
  }

  /// One entry a tile, those that get light.
  void sum() {
    std::ranges::sort(reach_);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < reach_.size(); ++i) {
      if (kept > 0 && reach_[kept - 1].first == reach_[i].first)
        reach_[kept - 1].second += reach_[i].second;
      else
        reach_[kept++] = reach_[i];
    }
    reach_.resize(kept);
    std::erase_if(reach_, [](const auto& tile) { return !(tile.second > 0.0f); });
  }

  void keepStrongest() {
    if (reach_.size() <= mostTilesOfARow) return;
    std::nth_element(reach_.begin(), reach_.begin() + mostTilesOfARow, reach_.end(),
                     [](const auto& a, const auto& b) {
                       return a.second != b.second ? a.second > b.second : a.first < b.first;
                     });
    reach_.resize(mostTilesOfARow);
  }

  const NearField& near_;
  const transport::NodeLayout& layout_;
  const Rasters& tiles_;
  int tileLevel_;
  Reach reach_;
  std::vector<Patch> narrow_, wide_;
};

/// Of all rows. A row has far more places on the way than tiles in the end: only some rows at a time have
/// room for them.
Reaches reachesOf(const NearField& near, const transport::NodeLayout& layout, const Rasters& tiles,
                  int tileLevel) {
  constexpr std::size_t rowsAtOnce = 16384;
  const std::size_t rows = near.unmix.size();
  Reaches result;
  result.start.assign(1, 0);
  result.start.reserve(rows + 1);
  std::vector<Reach> found(rowsAtOnce);
  for (std::size_t begin = 0; begin < rows; begin += rowsAtOnce) {
    const std::size_t count = std::min(rowsAtOnce, rows - begin);
    parallelChunks(0, count, 64, [&](std::size_t, std::size_t first, std::size_t last) {
      ReachFinder finder(near, layout, tiles, tileLevel);
      for (std::size_t i = first; i < last; ++i) found[i] = finder.of(begin + i);
    });
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
