// SPDX-License-Identifier: MIT
#include <QtTest>

#include "core/transport/random_blocks.h"
#include "relucent/acquisition/mixed_rows.h"

using namespace relucent;
using namespace relucent::transport;

class TestMixedRows : public QObject {
  Q_OBJECT

 private slots:
  void everyRowIsThatOfItsSource_data() {
    QTest::addColumn<bool>("shared");
    QTest::addColumn<bool>("othersShared");
    QTest::newRow("own colours") << false << false;
    QTest::newRow("shared colours") << true << false;
    QTest::newRow("shared among own colours") << false << true;
    QTest::newRow("shared colours both") << true << true;
  }
  /// Law: a row that was not chosen has the same bits; one that was chosen has the light of the other matrix,
  /// row by row and colour by colour.
  void everyRowIsThatOfItsSource() {
    QFETCH(bool, shared);
    QFETCH(bool, othersShared);
    constexpr std::size_t rows = 20, columns = 30;
    const BlockSparse first = shared ? randomSharedBlocks(rows, columns, 0.3, 1).sparse
                                     : randomBlocks(rows, columns, 0.3, 1).sparse;
    const BlockSparse second = othersShared ? randomSharedBlocks(rows, columns, 0.4, 2).sparse
                                            : randomBlocks(rows, columns, 0.4, 2).sparse;
    std::vector<std::uint8_t> chosen(rows, 0);
    for (std::size_t row = 0; row < rows; row += 3) chosen[row] = 1;
    const BlockSparse mixed = acquisition::mixedRows(first, second, chosen);
    QCOMPARE(mixed.sharedColours() != nullptr, shared);
    const Eigen::MatrixXd got = denseOf(mixed), kept = denseOf(first), again = denseOf(second);
    const Eigen::VectorXd white = Eigen::VectorXd::Ones(got.cols());
    for (std::size_t row = 0; row < rows; ++row) {
      const auto at = static_cast<Eigen::Index>(3 * row);
      if (!chosen[row]) {
        QVERIFY(got.middleRows(at, 3) == kept.middleRows(at, 3));
        continue;
      }
      // Colours that are shared keep the sum alone.
      const double off = ((got - again).middleRows(at, 3) * white).cwiseAbs().maxCoeff();
      QVERIFY2(off < 1e-3, qPrintable(QString::number(off)));
      if (!shared && !othersShared) QVERIFY(got.middleRows(at, 3) == again.middleRows(at, 3));
    }
  }
};

QTEST_GUILESS_MAIN(TestMixedRows)
#include "test_mixed_rows.moc"
