// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "random_blocks.h"
#include "relucent/transport/node_layout.h"

using namespace relucent;
using namespace relucent::transport;

namespace {

// Means are sums of at most some thousand single floats in tree order: a few roundings of 2^-24 each.
constexpr double rounding = 1e-6;

std::vector<Size> sizesOf(const QString& text) {
  std::vector<Size> sizes;
  for (const QString& size : text.split('+'))
    sizes.push_back({size.section('x', 0, 0).toInt(), size.section('x', 1, 1).toInt()});
  return sizes;
}

}  // namespace

class TestNodeLayout : public QObject {
  Q_OBJECT

 private slots:
  void sizes_data() {
    QTest::addColumn<QString>("sizes");
    for (const char* sizes :
         {"1x1", "2x2", "8x8", "13x7", "1x5", "64x3", "33x17", "13x7+1x5", "4x4+9x16+1x1"})
      QTest::newRow(sizes) << sizes;
  }

  void everyNodeHasOneNumber_data() { sizes_data(); }
  void everyNodeHasOneNumber() {
    QFETCH(QString, sizes);
    NodeLayout layout((Rasters(sizesOf(sizes))));
    std::size_t nodes = 0;
    for (std::size_t projector = 0; projector < layout.projectors().devices(); ++projector) {
      for (int level = 0; level < layout.levels(projector); ++level)
        nodes += layout.gridSize(projector, level).count();
      QCOMPARE(layout.gridSize(projector, layout.levels(projector) - 1).count(), std::size_t{1});
    }
    QCOMPARE(layout.count(), nodes);
    for (std::size_t index = 0; index < layout.count(); ++index)
      QCOMPARE(layout.index(layout.node(index)), index);
    for (std::size_t pixel = 0; pixel < layout.projectors().count(); ++pixel) {
      Node node = layout.nodeOver(pixel, 0);
      QCOMPARE(layout.index(node), pixel);
      QCOMPARE(layout.block(node).count(), 1);
    }
  }

  /// Law: who goes up through some of the numbers meets the nodes that have them, one more than once, too.
  void aCursorMeetsTheSameNodes_data() { sizes_data(); }
  void aCursorMeetsTheSameNodes() {
    QFETCH(QString, sizes);
    const NodeLayout layout((Rasters(sizesOf(sizes))));
    for (std::size_t step : {1u, 2u, 3u, 7u, 50u}) {
      NodeCursor nodeAt(layout);
      for (std::size_t index = step / 2; index < layout.count(); index += step) {
        QVERIFY(nodeAt(index) == layout.node(index));
        QVERIFY(nodeAt(index) == layout.node(index));
      }
      QVERIFY_EXCEPTION_THROWN(nodeAt(layout.count()), std::logic_error);
    }
  }

  void childrenPartitionTheirParent_data() { sizes_data(); }
  void childrenPartitionTheirParent() {
    QFETCH(QString, sizes);
    NodeLayout layout((Rasters(sizesOf(sizes))));
    for (std::size_t index = 0; index < layout.count(); ++index) {
      Node node = layout.node(index);
      QVERIFY(layout.block(node).count() > 0);
      if (node.level == 0) continue;
      int pixels = 0;
      for (const Node& child : layout.children(node)) {
        QVERIFY(layout.parent(child) == node);
        pixels += layout.block(child).count();
      }
      QCOMPARE(pixels, layout.block(node).count());
    }
  }

  void nodeOverIsTheBlockThatHoldsThePixel_data() { sizes_data(); }
  void nodeOverIsTheBlockThatHoldsThePixel() {
    QFETCH(QString, sizes);
    Rasters rasters(sizesOf(sizes));
    NodeLayout layout(rasters);
    for (std::size_t projector = 0; projector < rasters.devices(); ++projector) {
      for (std::size_t i = 0; i < rasters.size(projector).count(); ++i) {
        Pixel place = pixelAt(rasters.size(projector), i);
        for (int level = 0; level < layout.levels(projector); ++level) {
          Node node = layout.nodeOver(rasters.offset(projector) + i, level);
          Block block = layout.block(node);
          QCOMPARE(node.projector, static_cast<int>(projector));
          QCOMPARE(node.level, level);
          QVERIFY(place.x >= block.x0 && place.x < block.x1 && place.y >= block.y0 && place.y < block.y1);
        }
      }
    }
  }

  void meansAreThoseOfBruteForce_data() { sizes_data(); }
  void meansAreThoseOfBruteForce() {
    QFETCH(QString, sizes);
    Rasters rasters(sizesOf(sizes));
    NodeLayout layout(rasters);
    ProjectorStack pattern(randomStack(rasters.count(), 7));
    NodeStack means = layout.means(pattern);
    QCOMPARE(means.size(), 3 * layout.count());
    for (std::size_t index = 0; index < layout.count(); ++index) {
      Node node = layout.node(index);
      auto projector = static_cast<std::size_t>(node.projector);
      Block block = layout.block(node);
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (int y = block.y0; y < block.y1; ++y)
          for (int x = block.x0; x < block.x1; ++x)
            sum += static_cast<double>(
                pattern[3 * (rasters.offset(projector) + indexOf(rasters.size(projector), {x, y})) + c]);
        double mean = static_cast<double>(means[3 * index + c]);
        double expected = sum / block.count();
        QVERIFY2(std::abs(mean - expected) < rounding,
                 qPrintable(QString("node %1: %2, brute force %3").arg(index).arg(mean).arg(expected)));
      }
    }
  }

  /// <A p, v> = <p, A^T v>
  void spreadingIsTheAdjointOfMeans_data() { sizes_data(); }
  void spreadingIsTheAdjointOfMeans() {
    QFETCH(QString, sizes);
    NodeLayout layout((Rasters(sizesOf(sizes))));
    ProjectorStack pattern(randomStack(layout.projectors().count(), 11));
    NodeStack values(randomStack(layout.count(), 12));
    double left = vectorOf(layout.means(pattern)).dot(vectorOf(values));
    double right = vectorOf(pattern).dot(vectorOf(layout.meansAdjoint(values)));
    QVERIFY2(std::abs(left - right) < rounding * left, qPrintable(QString("%1 and %2").arg(left).arg(right)));
  }

  void lineByLineIsAllAtOnce_data() { sizes_data(); }
  /// The parts of which loops make fillMeans() and gatherMeansAdjoint() give the same bits.
  void lineByLineIsAllAtOnce() {
    QFETCH(QString, sizes);
    const NodeLayout layout{Rasters(sizesOf(sizes))};
    Random random{11};
    std::vector<float> values(3 * layout.count());
    for (float& value : values) value = random.uniformFloat();
    std::vector<float> lines = values, all = values;
    layout.fillMeans(all);
    for (std::size_t projector = 0; projector < layout.projectors().devices(); ++projector)
      for (int y = 0; layout.levels(projector) > 1 && y < layout.gridSize(projector, 1).height; ++y)
        layout.fillMeansOfLine(projector, y, lines);
    layout.fillMeansFrom(2, lines);
    QVERIFY(lines == all);

    lines = all = values;
    layout.gatherMeansAdjoint(all);
    layout.gatherAboveLines(lines);
    for (std::size_t projector = 0; projector < layout.projectors().devices(); ++projector)
      for (int y = 0; y < layout.projectors().size(projector).height; ++y)
        layout.addToLine(projector, y, lines);
    QVERIFY(std::equal(all.begin(),
                       all.begin() + 3 * static_cast<std::ptrdiff_t>(layout.projectors().count()),
                       lines.begin()));
  }

  void fourValuesANodeAreSpreadAsThree_data() { sizes_data(); }
  /// The same bits, with a value more.
  void fourValuesANodeAreSpreadAsThree() {
    QFETCH(QString, sizes);
    const NodeLayout layout{Rasters(sizesOf(sizes))};
    std::vector<float> three = randomStack(layout.count(), 13), four(4 * layout.count());
    for (std::size_t node = 0; node < layout.count(); ++node) {
      std::copy_n(&three[3 * node], 3, &four[4 * node]);
      four[4 * node + 3] = three[3 * node + 1];
    }
    layout.gatherMeansAdjoint(three);
    layout.gatherAboveLines(four, 4);
    for (std::size_t projector = 0; projector < layout.projectors().devices(); ++projector)
      for (int y = 0; y < layout.projectors().size(projector).height; ++y)
        layout.addToLine(projector, y, four, 4);
    for (std::size_t pixel = 0; pixel < layout.projectors().count(); ++pixel)
      for (std::size_t c = 0; c < 4; ++c) QCOMPARE(four[4 * pixel + c], three[3 * pixel + (c < 3 ? c : 1)]);
  }

  void breachesOfContractAreNamed() {
    NodeLayout layout((Rasters(Size{4, 4})));
    QVERIFY_EXCEPTION_THROWN(layout.node(layout.count()), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(layout.children({0, 0, 1, 1}), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(layout.means(ProjectorStack(5)), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(layout.meansAdjoint(NodeStack(5)), std::logic_error);
  }
};

QTEST_APPLESS_MAIN(TestNodeLayout)
#include "test_node_layout.moc"
