// SPDX-License-Identifier: MIT
#include <QtTest>
#include <algorithm>
#include <map>
#include <set>

#include "relucent/base/random.h"
#include "relucent/inverse/window_rows.h"

using namespace relucent;
using namespace relucent::inverse;
using namespace relucent::transport;

namespace {

constexpr std::size_t mostTilesOfARow = 64;  // as documented: a row serves no more

bool overlaps(const NodeLayout& layout, std::uint32_t a, std::uint32_t b) {
  if (layout.node(a).projector != layout.node(b).projector) return false;
  const Block p = layout.block(layout.node(a)), q = layout.block(layout.node(b));
  return p.x0 < q.x1 && q.x0 < p.x1 && p.y0 < q.y1 && q.y0 < p.y1;
}

/// Leaves of all levels, some of them negative, several equal.
NearField randomField(const NodeLayout& layout, std::size_t rows, bool nested, Random& random) {
  NearField near;
  near.unmix.assign(rows, ColourBlock::Identity());
  near.step.assign(rows, 1.0f / 1024.0f);
  near.start.assign(1, 0);
  for (std::size_t row = 0; row < rows; ++row) {
    std::set<std::uint32_t> nodes;
    for (std::uint64_t leaf = random.below(12); leaf > 0; --leaf) {
      const auto node = static_cast<std::uint32_t>(
          random.uniform() < 0.5 ? random.below(layout.count()) : layout.count() - 1 - random.below(20));
      if (nested || std::ranges::none_of(nodes, [&](auto other) { return overlaps(layout, node, other); }))
        nodes.insert(node);
    }
    for (std::uint32_t node : nodes) {
      near.node.push_back(node);
      const auto code = static_cast<std::int16_t>(10 * static_cast<int>(random.below(500)) - 1000);
      near.code.push_back({code, code, code});
    }
    near.start.push_back(near.node.size());
  }
  return near;
}

/// The rows of every tile by looking at every pixel of every leaf.
std::vector<std::vector<std::uint32_t>> rowsByBruteForce(const NearField& near, const NodeLayout& layout,
                                                         const Rasters& tiles,
                                                         const WindowSettings& settings) {
  std::vector<std::vector<std::pair<float, std::uint32_t>>> candidates(tiles.count());
  for (std::uint32_t row = 0; row + 1 < near.start.size(); ++row) {
    std::map<std::size_t, std::vector<float>> lights;
    for (std::size_t leaf = near.start[row]; leaf < near.start[row + 1]; ++leaf) {
      const Node node = layout.node(near.node[leaf]);
      const auto projector = static_cast<std::size_t>(node.projector);
      const NearField::Value value = near.value(row, leaf);
      float light = value[0] + value[1] + value[2];
      for (int side = settings.tile; side < (1 << node.level); side *= 2) light /= 4.0f;
      std::set<std::size_t> reached;
      const Block block = layout.block(node);
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x)
          reached.insert(tiles.offset(projector) +
                         indexOf(tiles.size(projector), {x / settings.tile, y / settings.tile}));
      for (std::size_t tile : reached) lights[tile].push_back(light);
    }
    std::vector<std::pair<float, std::size_t>> strength;  // negative, so that the strongest comes first
    for (auto& [tile, parts] : lights) {
      std::ranges::sort(parts);
      float sum = parts[0];
      for (std::size_t i = 1; i < parts.size(); ++i) sum += parts[i];
      if (sum > 0.0f) strength.emplace_back(-sum, tile);
    }
    std::ranges::sort(strength);
    strength.resize(std::min(strength.size(), mostTilesOfARow));
    for (const auto& [less, tile] : strength) candidates[tile].emplace_back(less, row);
  }
  std::vector<std::vector<std::uint32_t>> rows(tiles.count());
  for (std::size_t tile = 0; tile < rows.size(); ++tile) {
    std::ranges::sort(candidates[tile]);
    candidates[tile].resize(std::min(candidates[tile].size(), static_cast<std::size_t>(settings.rows)));
    for (const auto& candidate : candidates[tile]) rows[tile].push_back(candidate.second);
    std::ranges::sort(rows[tile]);
  }
  return rows;
}

}  // namespace

class TestWindowRows : public QObject {
  Q_OBJECT

 private slots:
  void aTileHasTheRowsThatReachItMost_data() {
    QTest::addColumn<int>("seed");
    QTest::addColumn<bool>("two");
    QTest::addColumn<bool>("nested");
    for (int seed : {1, 2, 3, 4})
      for (bool two : {false, true})
        for (bool nested : {false, true})
          QTest::addRow("seed %d, %s, %s", seed, two ? "two projectors" : "one", nested ? "nested" : "apart")
              << seed << two << nested;
  }
  /// Wide leaves, which reach more tiles than a row may serve, included.
  void aTileHasTheRowsThatReachItMost() {
    QFETCH(int, seed);
    QFETCH(bool, two);
    QFETCH(bool, nested);
    Random random{static_cast<std::uint64_t>(seed)};
    WindowSettings settings;
    settings.rows = 40;
    const std::vector<Size> sizes =
        two ? std::vector<Size>{{161, 147}, {140, 133}} : std::vector<Size>{{207, 151}};
    const NodeLayout layout{Rasters(sizes)};
    std::vector<Size> grid;
    for (const Size& size : sizes)
      grid.push_back({(size.width + settings.tile - 1) / settings.tile,
                      (size.height + settings.tile - 1) / settings.tile});
    const Rasters tiles(grid);
    QVERIFY(tiles.count() > 2 * mostTilesOfARow);
    const NearField near = randomField(layout, 120, nested, random);
    const WindowRows found = chooseWindowRows(near, layout, tiles, settings);
    const auto wanted = rowsByBruteForce(near, layout, tiles, settings);
    for (std::size_t tile = 0; tile < tiles.count(); ++tile)
      QCOMPARE(
          std::vector<std::uint32_t>(found.row.begin() + static_cast<std::ptrdiff_t>(found.start[tile]),
                                     found.row.begin() + static_cast<std::ptrdiff_t>(found.start[tile + 1])),
          wanted[tile]);
  }
};

QTEST_APPLESS_MAIN(TestWindowRows)
#include "test_window_rows.moc"
