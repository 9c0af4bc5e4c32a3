// SPDX-License-Identifier: MIT
#include "relucent/transport/matrix_density.h"

#include <QtTest>

#include "core/transport/expanded.h"
#include "core/transport/random_blocks.h"
#include "relucent/base/error.h"
#include "relucent/transport/footprint.h"
#include "relucent/transport/statistics.h"

using namespace relucent;
using namespace relucent::transport;
using Of = MatrixPictures::Of;

namespace {

std::shared_ptr<const TransportMatrix> randomTransport(const Rasters& cameras, const Rasters& projectors,
                                                       double density, std::uint64_t seed,
                                                       float lowest = -0.2f) {
  NodeLayout layout(projectors);
  return std::make_shared<TransportMatrix>(
      cameras, projectors, randomBlocks(cameras.count(), layout.count(), density, seed, lowest).sparse);
}

/// Luminance of every entry of T, from T written out.  Shape: camera pixels x projector pixels.
Eigen::MatrixXd luminanceOf(const TransportMatrix& transport) {
  Eigen::MatrixXd dense = expanded(transport);
  Eigen::RowVector3d weights(0.2126, 0.7152, 0.0722);
  Eigen::MatrixXd light(dense.rows() / 3, dense.cols() / 3);
  for (Eigen::Index i = 0; i < light.rows(); ++i)
    for (Eigen::Index j = 0; j < light.cols(); ++j)
      light(i, j) = (weights * dense.block<3, 3>(3 * i, 3 * j)).sum();
  return light;
}

double sumOf(const std::vector<float>& values) {
  double sum = 0.0;
  for (float value : values) sum += static_cast<double>(value);
  return sum;
}

/// Single floats, of which each cell's value is one rounding and coarse nodes' sums some more: a few hundred
/// leaves of magnitude below ten.
constexpr double rounding = 1e-3;

}  // namespace

class TestMatrixDensity : public QObject {
  Q_OBJECT

 private slots:
  void everyEntryIsThatOfT_data() {
    QTest::addColumn<double>("density");
    QTest::newRow("dense") << 0.5;
    QTest::newRow("sparse") << 0.03;
    QTest::newRow("empty") << 0.0;
  }
  void everyEntryIsThatOfT() {
    QFETCH(double, density);
    auto transport =
        randomTransport(std::vector<Size>{{5, 4}, {3, 1}}, std::vector<Size>{{11, 6}, {3, 2}}, density, 5);
    Eigen::MatrixXd light = luminanceOf(*transport);
    MatrixPictures pictures(transport);
    MatrixPart all = pictures.whole();
    MatrixDensity single =
        pictures.density(all, {static_cast<int>(all.columns()), static_cast<int>(all.rows())});
    for (std::size_t i = 0; i < all.rows(); ++i)
      for (std::size_t j = 0; j < all.columns(); ++j) {
        QCOMPARE(single.cellOf(i, j), (Pixel{static_cast<int>(j), static_cast<int>(i)}));
        double found = static_cast<double>(single.sums[i * all.columns() + j]);
        QVERIFY(std::abs(found - light(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))) < 1e-5);
      }
  }

  void cellsAddUpToTheirPartOfT_data() {
    QTest::addColumn<MatrixPart>("part");
    QTest::addColumn<Size>("cells");
    QTest::newRow("all in one") << MatrixPart{0, 28, 0, 105} << Size{1, 1};
    QTest::newRow("no powers of two") << MatrixPart{0, 28, 0, 105} << Size{13, 9};
    QTest::newRow("within one projector") << MatrixPart{3, 20, 17, 61} << Size{7, 5};
    QTest::newRow("over the border of two") << MatrixPart{1, 28, 80, 104} << Size{24, 27};
    QTest::newRow("whole lines") << MatrixPart{0, 28, 0, 99} << Size{9, 4};
    QTest::newRow("pairs of lines") << MatrixPart{0, 28, 22, 88} << Size{3, 7};
    QTest::newRow("lines of the second") << MatrixPart{5, 28, 99, 105} << Size{2, 3};
    QTest::newRow("one row") << MatrixPart{27, 28, 0, 105} << Size{105, 1};
    QTest::newRow("one column") << MatrixPart{0, 28, 50, 51} << Size{1, 28};
    QTest::newRow("one entry") << MatrixPart{9, 10, 104, 105} << Size{1, 1};
  }
  void cellsAddUpToTheirPartOfT() {
    QFETCH(MatrixPart, part);
    QFETCH(Size, cells);
    auto transport = randomTransport(Size{7, 4}, std::vector<Size>{{11, 9}, {3, 2}}, 0.3, 23);
    Eigen::MatrixXd light = luminanceOf(*transport);
    MatrixDensity picture = MatrixPictures(transport).density(part, cells);
    std::vector<double> expectedSums(cells.count(), 0.0);
    std::vector<std::size_t> entries(cells.count(), 0);
    for (std::size_t i = part.firstRow; i < part.endRow; ++i)
      for (std::size_t j = part.firstColumn; j < part.endColumn; ++j) {
        std::size_t cell = indexOf(cells, picture.cellOf(i, j));
        expectedSums[cell] += light(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        ++entries[cell];
      }
    for (int y = 0; y < cells.height; ++y)
      for (int x = 0; x < cells.width; ++x) {
        std::size_t at = indexOf(cells, {x, y});
        QCOMPARE(picture.entries({x, y}), entries[at]);
        QVERIFY(std::abs(static_cast<double>(picture.sums[at]) - expectedSums[at]) < rounding);
        QVERIFY(std::abs(static_cast<double>(picture.means()[at]) -
                         expectedSums[at] / static_cast<double>(entries[at])) < rounding);
      }
    double all =
        light
            .block(static_cast<Eigen::Index>(part.firstRow), static_cast<Eigen::Index>(part.firstColumn),
                   static_cast<Eigen::Index>(part.rows()), static_cast<Eigen::Index>(part.columns()))
            .sum();
    QVERIFY(std::abs(sumOf(picture.sums) - all) < rounding);
  }

  void aCellThatIsRefinedSplitsItsSum_data() {
    QTest::addColumn<int>("of");
    QTest::newRow("light") << static_cast<int>(Of::light);
    QTest::newRow("connections") << static_cast<int>(Of::connections);
  }
  void aCellThatIsRefinedSplitsItsSum() {
    QFETCH(int, of);
    auto transport = randomTransport(Size{8, 5}, Size{13, 7}, 0.2, 71);
    MatrixPictures pictures(transport);
    // 40 rows and 91 columns: 4 x 7 cells, each of 10 x 13 entries.
    MatrixDensity coarse = pictures.density(pictures.whole(), {7, 4}, static_cast<Of>(of));
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 7; ++x) {
        auto row = static_cast<std::size_t>(10 * y), column = static_cast<std::size_t>(13 * x);
        MatrixDensity fine =
            pictures.density({row, row + 10, column, column + 13}, {5, 3}, static_cast<Of>(of));
        QVERIFY(std::abs(sumOf(fine.sums) - static_cast<double>(coarse.sums[indexOf(coarse.cells, {x, y})])) <
                rounding);
      }
  }

  void connectionsAreThoseOfTheStatistics() {
    auto transport = randomTransport(Size{9, 7}, std::vector<Size>{{16, 8}, {5, 5}}, 0.1, 3);
    MatrixPictures pictures(transport);
    MatrixDensity picture = pictures.density(pictures.whole(), {6, 11}, Of::connections);
    QCOMPARE(sumOf(picture.sums), static_cast<double>(statisticsOf(*transport).connections));
  }

  void aCutLeavesOutWhatTheStatisticsLeaveOut_data() {
    QTest::addColumn<float>("absolute");
    QTest::addColumn<float>("share");
    QTest::newRow("nothing") << 0.0f << 0.0f;
    QTest::newRow("weak") << 0.05f << 0.0f;
    QTest::newRow("all but each row's strongest") << 100.0f << 0.0f;
    QTest::newRow("a share of the row") << 0.0f << 0.3f;
  }
  void aCutLeavesOutWhatTheStatisticsLeaveOut() {
    QFETCH(float, absolute);
    QFETCH(float, share);
    ThresholdSettings cut{.absolute = absolute, .shareOfRowMax = share};
    auto transport = randomTransport(Size{9, 7}, Size{16, 9}, 0.2, 37);
    MatrixPictures pictures(transport, cut);
    MatrixDensity counts = pictures.density(pictures.whole(), {10, 4}, Of::connections);
    QCOMPARE(sumOf(counts.sums), static_cast<double>(statisticsOf(*transport, cut).connections));
  }

  void aRowIsItsFootprint() {
    auto transport = randomTransport(Size{4, 3}, Size{12, 10}, 0.2, 91, 0.0f);
    MatrixPictures pictures(transport);
    for (std::size_t row = 0; row < 12; ++row) {
      MatrixDensity line = pictures.density({row, row + 1, 0, 120}, {120, 1});
      PixelFootprint footprint = footprintOf(*transport, row);
      for (std::size_t i = 0; i < 120; ++i)
        QVERIFY(std::abs(static_cast<double>(line.sums[i] - footprint.luminance[i])) < 1e-5);
    }
  }

  void aColumnIsWhatThePixelLights() {
    auto transport = randomTransport(Size{4, 3}, std::vector<Size>{{12, 10}, {2, 2}}, 0.2, 92);
    MatrixPictures pictures(transport);
    for (std::size_t column : {std::size_t{0}, std::size_t{77}, std::size_t{123}}) {
      MatrixDensity line = pictures.density({0, 12, column, column + 1}, {1, 12});
      std::vector<float> lit = lightOfPixel(*transport, column);
      for (std::size_t i = 0; i < 12; ++i)
        QVERIFY(std::abs(static_cast<double>(line.sums[i] - lit[i])) < 1e-5);
    }
  }

  /// An estimate is the exact sum of the rows that were taken, times those that each stands for.
  void someRowsStandForTheOthers_data() {
    QTest::addColumn<int>("step");
    QTest::newRow("all") << 1;
    QTest::newRow("every other") << 2;
    QTest::newRow("no divisor") << 5;
    QTest::newRow("more than a cell has") << 1000;
  }
  void someRowsStandForTheOthers() {
    QFETCH(int, step);
    auto transport = randomTransport(Size{9, 8}, std::vector<Size>{{11, 6}, {3, 2}}, 0.3, 11);
    MatrixPictures pictures(transport);
    MatrixPart part{2, 70, 5, 60};
    Size cells{7, 4};
    auto every = static_cast<std::size_t>(step);
    MatrixDensity estimate = pictures.density(part, cells, Of::light, every);
    for (int y = 0; y < cells.height; ++y) {
      std::size_t begin = part.firstRow + part.rows() * static_cast<std::size_t>(y) / 4;
      std::size_t end = part.firstRow + part.rows() * static_cast<std::size_t>(y + 1) / 4;
      std::vector<double> sums(7, 0.0);
      int taken = 0;
      for (std::size_t row = begin; row < end; row += every, ++taken) {
        MatrixDensity line = pictures.density({row, row + 1, 5, 60}, {7, 1});
        for (std::size_t x = 0; x < 7; ++x) sums[x] += static_cast<double>(line.sums[x]);
      }
      for (std::size_t x = 0; x < 7; ++x) {
        double wanted = sums[x] * static_cast<double>(end - begin) / taken;
        double found = static_cast<double>(estimate.sums[static_cast<std::size_t>(y) * 7 + x]);
        QVERIFY(std::abs(found - wanted) <= rounding * static_cast<double>(end - begin));
      }
    }
    QVERIFY_EXCEPTION_THROWN(pictures.density(part, cells, Of::light, 0), std::logic_error);
  }

  void askingForWhatIsNotThereIsABreach_data() {
    QTest::addColumn<MatrixPart>("part");
    QTest::addColumn<Size>("cells");
    QTest::newRow("no rows") << MatrixPart{3, 3, 0, 10} << Size{1, 1};
    QTest::newRow("beyond the rows") << MatrixPart{0, 13, 0, 10} << Size{1, 1};
    QTest::newRow("beyond the columns") << MatrixPart{0, 12, 0, 121} << Size{1, 1};
    QTest::newRow("more cells than rows") << MatrixPart{0, 2, 0, 10} << Size{1, 3};
    QTest::newRow("more cells than columns") << MatrixPart{0, 2, 0, 10} << Size{11, 1};
    QTest::newRow("no cells") << MatrixPart{0, 2, 0, 10} << Size{0, 1};
  }
  void askingForWhatIsNotThereIsABreach() {
    QFETCH(MatrixPart, part);
    QFETCH(Size, cells);
    MatrixPictures pictures(randomTransport(Size{4, 3}, Size{12, 10}, 0.2, 1));
    QVERIFY_EXCEPTION_THROWN(pictures.density(part, cells), std::logic_error);
  }

  void aSinglePixelIsAMatrixToo() {
    auto transport = randomTransport(Size{1, 1}, Size{1, 1}, 1.0, 8);
    MatrixPictures pictures(transport);
    MatrixDensity picture = pictures.density(pictures.whole(), {1, 1});
    QVERIFY(std::abs(static_cast<double>(picture.sums[0]) - luminanceOf(*transport)(0, 0)) < 1e-6);
  }
};

QTEST_GUILESS_MAIN(TestMatrixDensity)
#include "test_matrix_density.moc"
