// SPDX-License-Identifier: MIT
// Laws of the difference of two transport matrices, against rows expanded to single pixels.
#include <QTest>
#include <cmath>

#include "base/random.h"
#include "transport/difference.h"

using namespace relucent;

namespace {

/// Random leaves at all levels, nested ones among them.
TransportMatrix randomTransport(Size camera, Size projector, std::uint64_t seed, int leavesPerRow) {
  NodeLayout layout{Rasters(projector)};
  Random random{seed};
  BlockSparseBuilder builder(layout.count(), std::vector<float>(camera.count(), 2.0f));
  for (std::size_t row = 0; row < camera.count(); ++row) {
    for (int i = 0; i < leavesPerRow; ++i) {
      ColourBlock block;
      for (int k = 0; k < 9; ++k) block.data()[k] = random.uniformFloat() - 0.2f;
      builder.add(row, random.below(layout.count()), block);
    }
  }
  return TransportMatrix(Rasters(camera), Rasters(projector), builder.build());
}

std::vector<double> expandedRow(const TransportMatrix& transport, std::size_t row) {
  const NodeLayout& layout = transport.layout();
  Size size = transport.projectors().size(0);
  std::vector<double> pixels(size.count() * 9);
  const BlockSparse& leaves = transport.leaves();
  for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry) {
    Block area = layout.block(layout.node(leaves.column(entry)));
    ColourBlock block = leaves.block(row, entry);
    for (int y = area.y0; y < area.y1; ++y)
      for (int x = area.x0; x < area.x1; ++x)
        for (std::size_t k = 0; k < 9; ++k)
          pixels[indexOf(size, {x, y}) * 9 + k] += static_cast<double>(block.data()[k]) / area.count();
  }
  return pixels;
}

}  // namespace

class TestDifference : public QObject {
  Q_OBJECT
 private slots:
  void agreesWithExpandedRows_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::newRow("power of two") << 8 << 8;
    QTest::newRow("odd") << 13 << 7;
    QTest::newRow("line") << 1 << 9;
  }
  void agreesWithExpandedRows() {
    QFETCH(int, width);
    QFETCH(int, height);
    Size camera{5, 4};
    TransportMatrix a = randomTransport(camera, {width, height}, 1, 9);
    TransportMatrix b = randomTransport(camera, {width, height}, 2, 9);
    double apart = 0.0;
    double whole = 0.0;
    for (std::size_t row = 0; row < camera.count(); ++row) {
      std::vector<double> ra = expandedRow(a, row);
      std::vector<double> rb = expandedRow(b, row);
      for (std::size_t i = 0; i < ra.size(); ++i) {
        apart += (ra[i] - rb[i]) * (ra[i] - rb[i]);
        whole += rb[i] * rb[i];
      }
    }
    double expected = std::sqrt(apart / whole);
    // Both sides sum in double precision: only their order differs.
    QVERIFY(std::abs(difference(a, b).frobenius - expected) < 1e-9 * expected);
  }
  void vanishesOnItself() {
    TransportMatrix a = randomTransport({6, 3}, {11, 5}, 3, 12);
    TransportDifference none = difference(a, a);
    QVERIFY2(none.frobenius < 1e-7, qPrintable(QString::number(none.frobenius)));
    QVERIFY(none.rowP95 < 1e-7);
    QCOMPARE(none.rows, std::size_t{18});
  }
  void refusesOtherDevices() {
    TransportMatrix a = randomTransport({6, 3}, {11, 5}, 3, 2);
    TransportMatrix b = randomTransport({3, 6}, {11, 5}, 3, 2);
    QVERIFY_THROWS_EXCEPTION(std::logic_error, difference(a, b));
  }
};

QTEST_APPLESS_MAIN(TestDifference)
#include "test_difference.moc"
