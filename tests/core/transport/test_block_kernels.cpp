// SPDX-License-Identifier: MIT
#include "relucent/transport/block_kernels.h"

#include <QtTest>
#include <cmath>
#include <limits>

#include "random_blocks.h"

using namespace relucent;
using namespace relucent::transport;

namespace {

constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

// Each of n products and each of n sums rounds by 2^-24 of a partial sum of at most n, values up to 1;
// versions that fuse multiply and add round half as often.
double roundingOf(std::size_t terms) {
  return 2.0 * static_cast<double>(terms) * static_cast<double>(terms) * 0x1.0p-24;
}

Stack gathered(const BlockKernels& kernels, const BlockSparse& blocks, const Stack& x) {
  Stack y(3 * blocks.rows());
  kernels.gather(blocks.view(), 0, blocks.rows(), x.data(), y.data());
  return y;
}

Stack scattered(const BlockKernels& kernels, const BlockSparse& blocks, const Stack& y) {
  ColumnSums sums(blocks.columns());
  kernels.scatter(blocks.view(), 0, blocks.rows(), y.data(), sums);
  Stack x;
  for (std::size_t column = 0; column < blocks.columns(); ++column)
    x.insert(x.end(), sums.at(column), sums.at(column) + 3);
  return x;
}

bool finite(const Stack& values, std::size_t pixel) {
  return std::isfinite(values[3 * pixel]) && std::isfinite(values[3 * pixel + 1]) &&
         std::isfinite(values[3 * pixel + 2]);
}

}  // namespace

class TestBlockKernels : public QObject {
  Q_OBJECT

 private slots:
  void versions_data() {
    QTest::addColumn<int>("version");
    for (std::size_t i = 0; i < blockKernels().size(); ++i)
      QTest::newRow(blockKernels()[i].instructions) << static_cast<int>(i);
  }

  void productsAreThoseOfTheDenseMatrix_data() { versions_data(); }
  void productsAreThoseOfTheDenseMatrix() {
    QFETCH(int, version);
    const BlockKernels& kernels = blockKernels()[static_cast<std::size_t>(version)];
    struct Shape {
      std::size_t rows, columns;
      double density;
    };
    for (Shape shape : {Shape{1, 1, 1.0}, {5, 3, 0.0}, {97, 5, 0.5}, {3, 1101, 0.3}, {120, 200, 0.1}}) {
      for (const RandomBlocks& blocks : {randomBlocks(shape.rows, shape.columns, shape.density, 1, -1.0f),
                                         randomSharedBlocks(shape.rows, shape.columns, shape.density, 1)}) {
        Stack x = randomStack(shape.columns, 2), y = randomStack(shape.rows, 3);
        Eigen::VectorXd forward = blocks.dense * vectorOf(x), back = blocks.dense.transpose() * vectorOf(y);
        double forwardError = (vectorOf(gathered(kernels, blocks.sparse, x)) - forward).cwiseAbs().maxCoeff();
        double backError = (vectorOf(scattered(kernels, blocks.sparse, y)) - back).cwiseAbs().maxCoeff();
        QVERIFY2(forwardError <= roundingOf(3 * shape.columns), qPrintable(QString::number(forwardError)));
        QVERIFY2(backError <= roundingOf(3 * shape.rows), qPrintable(QString::number(backError)));
      }
    }
  }

  /// Every code of a block and both ends of its range, each on its own.
  void everyCodeCountsOnceInItsPlace_data() { versions_data(); }
  void everyCodeCountsOnceInItsPlace() {
    QFETCH(int, version);
    const BlockKernels& kernels = blockKernels()[static_cast<std::size_t>(version)];
    for (std::size_t place = 0; place < 9; ++place) {
      for (int value : {-32767, -1, 1, 32767}) {
        std::array<std::int16_t, 9> code{};
        code[place] = static_cast<std::int16_t>(value);
        BlockSparse block = BlockSparse::assembled(1, {0, 1}, {0}, {code}, {1.0f});
        Stack forward(3, 0.0f), back(3, 0.0f);
        forward[place / 3] = static_cast<float>(value) * static_cast<float>(place % 3 + 1);
        back[place % 3] = static_cast<float>(value) * static_cast<float>(place / 3 + 1);
        QCOMPARE(gathered(kernels, block, {1, 2, 3}), forward);
        QCOMPARE(scattered(kernels, block, {1, 2, 3}), back);
      }
    }
  }

  /// Vectors are wider than three channels: what lies beside a pixel must not leak into it.
  void aPixelThatIsNoNumberSpoilsOnlyWhatSeesIt_data() { versions_data(); }
  void aPixelThatIsNoNumberSpoilsOnlyWhatSeesIt() {
    QFETCH(int, version);
    const BlockKernels& kernels = blockKernels()[static_cast<std::size_t>(version)];
    constexpr std::size_t pixels = 7;
    BlockSparseBuilder diagonal(pixels, std::vector<float>(pixels, 1.0f));
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) diagonal.add(pixel, pixel, ColourBlock::Ones());
    BlockSparse blocks = diagonal.build();
    for (std::size_t spoilt = 0; spoilt < pixels; ++spoilt) {
      for (std::size_t c = 0; c < 3; ++c) {
        Stack values(3 * pixels, 1.0f);
        values[3 * spoilt + c] = notANumber;
        Stack forward = gathered(kernels, blocks, values), back = scattered(kernels, blocks, values);
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
          QCOMPARE(finite(forward, pixel), pixel != spoilt);
          QCOMPARE(finite(back, pixel), pixel != spoilt);
        }
      }
    }
  }

  void onlyRowsThatAreAskedForAreDone_data() { versions_data(); }
  void onlyRowsThatAreAskedForAreDone() {
    QFETCH(int, version);
    const BlockKernels& kernels = blockKernels()[static_cast<std::size_t>(version)];
    BlockSparse blocks = randomBlocks(20, 30, 0.5, 4).sparse;
    Stack x = randomStack(30, 5), whole = gathered(kernels, blocks, x), part(60, -1.0f);
    kernels.gather(blocks.view(), 5, 9, x.data(), part.data());
    for (std::size_t i = 0; i < part.size(); ++i) QCOMPARE(part[i], i >= 15 && i < 27 ? whole[i] : -1.0f);

    Stack y = randomStack(20, 6), dark = y;
    for (std::size_t i = 0; i < dark.size(); ++i)
      if (i < 15 || i >= 27) dark[i] = 0.0f;
    ColumnSums sums(30);
    kernels.scatter(blocks.view(), 5, 9, y.data(), sums);
    Stack expected = scattered(kernels, blocks, dark);
    for (std::size_t i = 0; i < expected.size(); ++i) QCOMPARE(sums.at(i / 3)[i % 3], expected[i]);
  }

  void sumsTakeMemoryOnlyWhereSomethingIsAdded() {
    ColumnSums sums(3 * ColumnSums::tileColumns + 1);
    QCOMPARE(sums.tiles(), std::size_t{4});
    sums.at(3 * ColumnSums::tileColumns)[2] = 5.0f;
    for (std::size_t tile = 0; tile < 3; ++tile) QVERIFY(sums.tile(tile) == nullptr);
    QCOMPARE(sums.tile(3)[2], 5.0f);
    QCOMPARE(ColumnSums().tiles(), std::size_t{0});
  }
};

QTEST_APPLESS_MAIN(TestBlockKernels)
#include "test_block_kernels.moc"
