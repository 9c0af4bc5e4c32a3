// SPDX-License-Identifier: MIT
#include <QtTest>
#include <numeric>

#include "relucent/multiplexing/division.h"

using namespace relucent;
using namespace relucent::multiplexing;
using namespace relucent::transport;

namespace {

/// Light of a leaf where `light` says so, elsewhere next to none.
std::vector<Row> rowsWith(const NodeLayout& layout, std::size_t count, int level) {
  std::vector<Row> rows(count);
  for (Row& row : rows) {
    row.leaves = startingLeaves(layout, level, 0.1f);
    for (Leaf& leaf : row.leaves) {
      leaf.light = 0.002f;
      leaf.deviation = 0.001f;
    }
  }
  return rows;
}

Rows together(const std::vector<Row>& rows) {
  Rows result(rows.size(), 0);
  result.change([&](std::size_t row, std::vector<Leaf>& leaves) { leaves = rows[row].leaves; });
  return result;
}

/// The rows, divided.
void divideAll(std::vector<Row>& rows, Size camera, const NodeLayout& layout, int level,
               const std::vector<float>& thresholds, const DivisionSettings& settings) {
  Rows all = together(rows);
  divide(all, Rasters(camera), layout, level, thresholds, settings);
  for (std::size_t row = 0; row < rows.size(); ++row) all.read(row, rows[row]);
}

double lightOf(const Row& row) {
  return std::accumulate(row.leaves.begin(), row.leaves.end(), 0.0,
                         [](double sum, const Leaf& leaf) { return sum + static_cast<double>(leaf.light); });
}

/// Every projector pixel belongs to one leaf.
void coversOnce(const NodeLayout& layout, const Row& row) {
  std::vector<int> covered(layout.projectors().count(), 0);
  for (const Leaf& leaf : row.leaves) {
    Node node = layout.node(leaf.node);
    Block block = layout.block(node);
    auto projector = static_cast<std::size_t>(node.projector);
    for (int y = block.y0; y < block.y1; ++y)
      for (int x = block.x0; x < block.x1; ++x)
        ++covered[layout.projectors().offset(projector) +
                  indexOf(layout.projectors().size(projector), {x, y})];
  }
  for (int times : covered) QCOMPARE(times, 1);
}

}  // namespace

class TestDivision : public QObject {
  Q_OBJECT

 private slots:
  void startsCoverEveryProjector_data() {
    QTest::addColumn<int>("nodes");
    for (int nodes : {1, 4, 48, 1000}) QTest::addRow("%d nodes", nodes) << nodes;
  }
  void startsCoverEveryProjector() {
    QFETCH(int, nodes);
    NodeLayout layout(Rasters({{29, 19}, {5, 3}, {1, 1}}));
    int level = startingLevel(layout, nodes);
    Row row{startingLeaves(layout, level, 0.1f), {}, 0.0f};
    coversOnce(layout, row);
    QVERIFY(row.leaves.size() >= static_cast<std::size_t>(nodes) || level == 0);
    QVERIFY(std::abs(lightOf(row) - 1.0) < 0x1p-11);  // that of halves
  }

  void strongLeavesAreDivided() {
    NodeLayout layout(Size{29, 19});
    std::vector<Row> rows = rowsWith(layout, 1, 2);
    std::size_t before = rows[0].leaves.size();
    rows[0].leaves[3].light = 0.1f;
    double light = lightOf(rows[0]);
    divideAll(rows, Size{1, 1}, layout, 2, {0.012f}, {});
    coversOnce(layout, rows[0]);
    QVERIFY(std::abs(lightOf(rows[0]) - light) < 1e-6);
    QVERIFY(std::count_if(rows[0].leaves.begin(), rows[0].leaves.end(),
                          [&](const Leaf& leaf) { return layout.node(leaf.node).level == 1; }) >= 2);
    QVERIFY(rows[0].leaves.size() < before);  // the others are joined
    QVERIFY(std::is_sorted(rows[0].leaves.begin(), rows[0].leaves.end(),
                           [](const Leaf& a, const Leaf& b) { return a.node < b.node; }));
  }

  void noiseIsNotFollowed() {
    NodeLayout layout(Size{16, 16});
    std::vector<Row> rows = rowsWith(layout, 1, 2);
    rows[0].leaves[3].light = 0.1f;
    rows[0].leaves[3].deviation = 0.2f;
    divideAll(rows, Size{1, 1}, layout, 2, {0.012f}, {2.0f, 1.5f, 0.0f});
    for (const Leaf& leaf : rows[0].leaves) QCOMPARE(layout.node(leaf.node).level, 2);
  }

  void neighboursAreFollowed() {
    NodeLayout layout(Size{16, 16});
    std::vector<Row> rows = rowsWith(layout, 9, 2);
    for (std::size_t row = 0; row < 9; ++row)
      if (row != 4) rows[row].leaves[3].light = 0.1f;
    divideAll(rows, Size{3, 3}, layout, 2, std::vector<float>(9, 0.012f), {2.0f, 1.5f, 0.0f});
    QVERIFY(std::any_of(rows[4].leaves.begin(), rows[4].leaves.end(),
                        [&](const Leaf& leaf) { return layout.node(leaf.node).level == 1; }));
    for (const Row& row : rows) coversOnce(layout, row);
  }

  void childrenAreCountedBefore_data() {
    QTest::addColumn<int>("level");
    for (int level : {3, 2, 1}) QTest::addRow("level %d", level) << level;
  }
  /// As many as dividing then makes, also at the border, and where neighbours ask for them.
  void childrenAreCountedBefore() {
    QFETCH(int, level);
    NodeLayout layout(Rasters({{29, 19}, {13, 9}}));
    std::vector<Row> rows = rowsWith(layout, 9, level);
    rows[7].leaves.clear();
    for (std::size_t row = 0; row < 6; ++row)
      for (std::size_t leaf = row; leaf < rows[row].leaves.size(); leaf += 2)
        rows[row].leaves[leaf].light = 0.1f;
    const std::vector<float> thresholds(9, 0.012f);
    std::vector<std::size_t> counted =
        childrenAfterDivision(together(rows), Rasters(Size{3, 3}), layout, level, thresholds, {});
    divideAll(rows, Size{3, 3}, layout, level, thresholds, {});
    for (std::size_t row = 0; row < rows.size(); ++row)
      QCOMPARE(counted[row],
               static_cast<std::size_t>(std::ranges::count_if(rows[row].leaves, [&](const Leaf& leaf) {
                 return layout.node(leaf.node).level == level - 1;
               })));
    QVERIFY(counted[0] > 0);
    QVERIFY(counted[8] < counted[0]);
  }

  /// What was divided in vain is one leaf again, with the same light.
  void siblingsAreJoined() {
    NodeLayout layout(Size{13, 9});
    std::vector<Row> rows = rowsWith(layout, 1, 0);
    double light = lightOf(rows[0]);
    divideAll(rows, Size{1, 1}, layout, 0, {0.012f}, {});
    coversOnce(layout, rows[0]);
    QVERIFY(std::abs(lightOf(rows[0]) - light) < 1e-5);
    for (const Leaf& leaf : rows[0].leaves) QCOMPARE(layout.node(leaf.node).level, 1);
  }

  void rowsWithoutLeavesStayEmpty() {
    NodeLayout layout(Size{8, 8});
    std::vector<Row> rows = rowsWith(layout, 2, 1);
    rows[0].leaves.clear();
    divideAll(rows, Size{2, 1}, layout, 1, {0.012f, 0.012f}, {});
    QVERIFY(rows[0].leaves.empty());
    coversOnce(layout, rows[1]);
  }
};

QTEST_MAIN(TestDivision)
#include "test_division.moc"
