// SPDX-License-Identifier: MIT
// Laws of the difference of two transport matrices, against rows expanded to single pixels.
#include <QTest>
#include <cmath>

#include "core/transport/expanded.h"
#include "relucent/base/random.h"
#include "relucent/transport/difference.h"

using namespace relucent;
using namespace relucent::transport;

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
    double expected = (expanded(a) - expanded(b)).norm() / expanded(b).norm();
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
  void rowsDifferWhereAValueDoes() {
    const TransportMatrix a = randomTransport({6, 3}, {11, 5}, 3, 12);
    QVERIFY(differingRows(a, a) == CameraMask(18, 0));
    Stack factor(3 * 18, 1.0f);
    factor[3 * 4 + 1] = 0.999f;
    factor[3 * 17] = 0.5f;
    CameraMask expected(18, 0);
    expected[4] = expected[17] = 1;
    QVERIFY(differingRows(a.withRowsScaled(factor), a) == expected);
    const TransportMatrix fewer =
        a.filtered([](std::size_t row, const LeafRow& leaves, std::vector<std::uint8_t>& keep) {
          keep.assign(leaves.size(), 1);
          if (row == 7) keep.back() = 0;
        });
    expected.assign(18, 0);
    expected[7] = 1;
    QVERIFY(differingRows(fewer, a) == expected);
  }
  void refusesOtherDevices() {
    TransportMatrix a = randomTransport({6, 3}, {11, 5}, 3, 2);
    TransportMatrix b = randomTransport({3, 6}, {11, 5}, 3, 2);
    QVERIFY_THROWS_EXCEPTION(std::logic_error, difference(a, b));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, differingRows(a, b));
  }
};

QTEST_APPLESS_MAIN(TestDifference)
#include "test_difference.moc"
