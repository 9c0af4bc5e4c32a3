// SPDX-License-Identifier: MIT
#include <tbb/global_control.h>

#include <QtTest>
#include <cmath>

#include "random_blocks.h"

using namespace relucent;
using namespace relucent::transport;

namespace {

// A sum of n products in single floats, values up to 1: n roundings of 2^-24 at the size of the sum.
double roundingOf(std::size_t terms) {
  return static_cast<double>(terms) * static_cast<double>(terms) * 0x1.0p-24;
}

double largestDifference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace

class TestBlockSparse : public QObject {
  Q_OBJECT

 private slots:
  void shapes_data() {
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("columns");
    QTest::addColumn<double>("density");
    QTest::newRow("empty") << 5 << 3 << 0.0;
    QTest::newRow("single") << 1 << 1 << 1.0;
    QTest::newRow("tall") << 97 << 5 << 0.5;
    QTest::newRow("wide") << 3 << 101 << 0.3;
    QTest::newRow("large") << 300 << 200 << 0.05;
  }

  void productsAreThoseOfTheDenseMatrix_data() { shapes_data(); }
  void productsAreThoseOfTheDenseMatrix() {
    QFETCH(int, rows);
    QFETCH(int, columns);
    QFETCH(double, density);
    auto r = static_cast<std::size_t>(rows), c = static_cast<std::size_t>(columns);
    RandomBlocks blocks = randomBlocks(r, c, density, 1);
    QVERIFY((density == 0.0) == (blocks.sparse.blocks() == 0));
    Stack x = randomStack(c, 2), y = randomStack(r, 3);
    QVERIFY(largestDifference(vectorOf(blocks.sparse.multiply(x)), blocks.dense * vectorOf(x)) <
            roundingOf(3 * c));
    QVERIFY(largestDifference(vectorOf(blocks.sparse.multiplyTransposed(y)),
                              blocks.dense.transpose() * vectorOf(y)) < roundingOf(3 * r));
  }

  /// Requantised on the columns' own scales, each the column's largest / 32767.
  void transposedIsTheDenseTranspose_data() { shapes_data(); }
  void transposedIsTheDenseTranspose() {
    QFETCH(int, rows);
    QFETCH(int, columns);
    QFETCH(double, density);
    RandomBlocks blocks =
        randomBlocks(static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), density, 4);
    BlockSparse transposed = blocks.sparse.transposed();
    QCOMPARE(transposed.rows(), blocks.sparse.columns());
    QCOMPARE(transposed.columns(), blocks.sparse.rows());
    QVERIFY((denseOf(transposed) - blocks.dense.transpose()).cwiseAbs().maxCoeff() <= 0.5001 / 32767);
    for (std::size_t row = 0; row < transposed.rows(); ++row)
      for (std::size_t entry = transposed.rowBegin(row) + 1; entry < transposed.rowBegin(row + 1); ++entry)
        QVERIFY(transposed.column(entry - 1) < transposed.column(entry));
  }

  void productsAreTheSameBitsForEveryNumberOfThreads() {
    RandomBlocks blocks = randomBlocks(600, 300, 0.1, 5);
    Stack x = randomStack(300, 6), y = randomStack(600, 7);
    Stack forward = blocks.sparse.multiply(x), back = blocks.sparse.multiplyTransposed(y);
    for (std::size_t threads : {1, 3}) {
      tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      QVERIFY(blocks.sparse.multiply(x) == forward);
      QVERIFY(blocks.sparse.multiplyTransposed(y) == back);
    }
  }

  void darkRowsDoNotChangeTheTransposedProduct() {
    RandomBlocks blocks = randomBlocks(50, 20, 0.4, 8);
    Stack y = randomStack(50, 9);
    for (std::size_t row = 0; row < 50; ++row)
      if (row % 3 != 0) y[3 * row] = y[3 * row + 1] = y[3 * row + 2] = 0.0f;
    QVERIFY(largestDifference(vectorOf(blocks.sparse.multiplyTransposed(y)),
                              blocks.dense.transpose() * vectorOf(y)) < roundingOf(150));
  }

  void quantisationIsHalfAStepOfTheRow() {
    Random random{10};
    std::vector<float> fullScale{1.0f, 1e-6f, 3e4f};
    BlockSparseBuilder builder(40, fullScale);
    std::vector<ColourBlock> stored;
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 40; ++column) {
        ColourBlock block;
        for (int i = 0; i < 9; ++i) block.data()[i] = fullScale[row] * (2.0f * random.uniformFloat() - 1.0f);
        stored.push_back(block);
        builder.add(row, column, block);
      }
    BlockSparse blocks = builder.build();
    QCOMPARE(blocks.blocks(), std::size_t{120});
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t entry = blocks.rowBegin(row); entry < blocks.rowBegin(row + 1); ++entry) {
        float error = (blocks.block(row, entry) - stored[entry]).cwiseAbs().maxCoeff();
        QVERIFY2(error <= fullScale[row] * (0.5f / 32767.0f + 2e-7f), qPrintable(QString::number(error)));
      }
  }

  void blocksAtTheSamePlaceAddUpInAnyOrder() {
    BlockSparseBuilder builder(9, {1.0f, 1.0f});
    builder.add(1, 7, ColourBlock::Constant(0.25f));
    builder.add(1, 2, ColourBlock::Constant(0.5f));
    builder.add(0, 8, ColourBlock::Constant(0.125f));
    builder.add(1, 7, ColourBlock::Constant(0.5f));
    builder.add(1, 3, ColourBlock::Zero());
    builder.add(0, 1, ColourBlock::Constant(7.0f));
    BlockSparse blocks = builder.build();
    QCOMPARE(blocks.blocks(), std::size_t{4});
    QCOMPARE(blocks.column(0), 1u);
    QCOMPARE(blocks.column(1), 8u);
    QCOMPARE(blocks.column(2), 2u);
    QCOMPARE(blocks.column(3), 7u);
    QVERIFY(std::abs(blocks.block(1, 3)(2, 2) - 0.75f) <= 1.0f / 32767.0f);
    QCOMPARE(blocks.block(0, 0)(0, 0), 1.0f);  // saturates at the row's full scale
  }

  void writingRowsIsBuilding() {
    RandomBlocks blocks = randomBlocks(40, 30, 0.3, 17);
    BlockSparseWriter writer(30, std::vector<float>(40, 1.0f), blocks.sparse.blocks());
    for (std::size_t row = 0; row < 40; ++row) {
      for (std::size_t entry = blocks.sparse.rowBegin(row + 1); entry-- > blocks.sparse.rowBegin(row);)
        writer.add(blocks.sparse.column(entry), blocks.sparse.code(entry));
      writer.add(3, {});
      writer.endRow();
    }
    QVERIFY_EXCEPTION_THROWN(writer.endRow(), std::logic_error);
    QVERIFY(writer.build() == blocks.sparse);
    BlockSparseWriter unfinished(30, std::vector<float>(2, 1.0f), 0);
    unfinished.endRow();
    QVERIFY_EXCEPTION_THROWN(unfinished.build(), std::logic_error);
  }

  void rowsAreScaledPerCameraChannel() {
    RandomBlocks blocks = randomBlocks(40, 30, 0.3, 13);
    Stack factor = randomStack(40, 14);
    factor[0] = factor[1] = factor[2] = 0.0f;
    for (float& value : factor) value *= 3.0f;
    Eigen::MatrixXd expected = vectorOf(factor).asDiagonal() * blocks.dense;
    BlockSparse scaled = blocks.sparse.withRowsScaled(factor);
    QVERIFY((denseOf(scaled) - expected).cwiseAbs().maxCoeff() <= 3.0 * 0.501 / 32767);
    QCOMPARE(denseOf(scaled).topRows(3).cwiseAbs().maxCoeff(), 0.0);
  }

  void filteringKeepsExactlyWhatIsAskedFor() {
    RandomBlocks blocks = randomBlocks(30, 40, 0.3, 15);
    auto odd = [&](std::size_t, std::size_t entry) { return blocks.sparse.column(entry) % 2 == 1; };
    BlockSparse kept = blocks.sparse.filtered(odd);
    Eigen::MatrixXd expected = blocks.dense;
    for (Eigen::Index column = 0; column < expected.cols(); column += 6)
      expected.middleCols(column, 3).setZero();
    QVERIFY(denseOf(kept) == expected);
    QVERIFY(blocks.sparse.filtered([](std::size_t, std::size_t) { return true; }) == blocks.sparse);
  }

  void breachesOfContractAreNamed() {
    BlockSparse blocks = randomBlocks(3, 4, 1.0, 16).sparse;
    QVERIFY_EXCEPTION_THROWN(blocks.multiply(Stack(9)), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(blocks.multiplyTransposed(Stack(12)), std::logic_error);
    BlockSparseBuilder builder(4, {1.0f});
    QVERIFY_EXCEPTION_THROWN(builder.add(1, 0, ColourBlock::Ones()), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(builder.add(0, 4, ColourBlock::Ones()), std::logic_error);
  }

  /// Every operation is that of the dense matrix, whatever the form.
  void sharedColoursAreBlocksLikeOthers_data() { shapes_data(); }
  void sharedColoursAreBlocksLikeOthers() {
    QFETCH(int, rows);
    QFETCH(int, columns);
    QFETCH(double, density);
    auto r = static_cast<std::size_t>(rows), c = static_cast<std::size_t>(columns);
    const RandomBlocks blocks = randomSharedBlocks(r, c, density, 1);
    QVERIFY(blocks.sparse.sharedColours() != nullptr);
    const Stack x = randomStack(c, 2), y = randomStack(r, 3), factor = randomStack(r, 4);
    QVERIFY(largestDifference(vectorOf(blocks.sparse.multiply(x)), blocks.dense * vectorOf(x)) <
            roundingOf(3 * c));
    QVERIFY(largestDifference(vectorOf(blocks.sparse.multiplyTransposed(y)),
                              blocks.dense.transpose() * vectorOf(y)) < roundingOf(3 * r));
    // Not quantised again: the error is that of single precision.
    QVERIFY((denseOf(blocks.sparse.withRowsScaled(factor)) - vectorOf(factor).asDiagonal() * blocks.dense)
                .cwiseAbs()
                .maxCoeff() < 0x1.0p-22);
    const BlockSparse odd =
        blocks.sparse.filtered([](std::size_t row, std::size_t entry) { return (row + entry) % 2 == 1; });
    const BlockSparse even =
        blocks.sparse.filtered([](std::size_t row, std::size_t entry) { return (row + entry) % 2 == 0; });
    QCOMPARE(odd.blocks() + even.blocks(), blocks.sparse.blocks());
    QVERIFY(denseOf(odd) + denseOf(even) == blocks.dense);
    const Eigen::MatrixXd transposed = denseOf(blocks.sparse.transposed());
    QVERIFY((transposed - blocks.dense.transpose()).cwiseAbs().maxCoeff() <= 0.51 / 32767.0);
    for (std::size_t row = 0; row < r; ++row)
      for (std::size_t entry = blocks.sparse.rowBegin(row); entry < blocks.sparse.rowBegin(row + 1);
           ++entry) {
        const ColourBlock block = blocks.sparse.block(row, entry);
        const BlockSize size = blocks.sparse.sizeOf(row, entry);
        QCOMPARE(size.largest, block.cwiseAbs().maxCoeff());
        QCOMPARE(size.sum, block.cwiseAbs().sum());
      }
  }

  void colourFits_data() {
    QTest::addColumn<float>("noise");  // of the blocks' colours, relative
    QTest::newRow("shared") << 0.0f;
    QTest::newRow("nearly shared") << 0.1f;
    QTest::newRow("own") << 1.0f;
  }
  /// The sum of a kind's blocks is kept whatever their colours, to a step of rounding; blocks whose colours
  /// are shared are kept one by one.
  void theSumOfBlocksIsKept_data() { colourFits_data(); }
  void theSumOfBlocksIsKept() {
    QFETCH(float, noise);
    constexpr std::size_t columns = 60;
    const ColumnKinds kinds = someKinds(columns);
    Random random{5};
    std::vector<std::uint32_t> places;
    std::vector<ColourBlock> blocks, sum(kinds.count, ColourBlock::Zero());
    for (std::uint32_t column = 0; column < columns; column += 1 + column % 3) {
      ColourBlock colours;
      colours << 1.0f, 0.1f, 0.02f, 0.2f, 0.8f, 0.1f, 0.05f, 0.1f, 0.6f;
      for (int i = 0; i < 9; ++i) colours.data()[i] *= 1.0f + noise * (random.uniformFloat() - 0.5f);
      places.push_back(column);
      blocks.push_back(random.uniformFloat() * colours);
      sum[kinds.kindOf(column)] += blocks.back();
    }
    SharedColourRow encoded;
    SharedColourEncoder(kinds).encode(places, blocks, encoded);
    SharedColourWriter writer(columns, 1, kinds, 0);
    writer.add(encoded);
    const BlockSparse row = writer.build();
    QCOMPARE(row.blocks(), blocks.size());
    for (std::size_t entry = 0; entry < row.blocks(); ++entry) {
      const float off = (row.block(0, entry) - blocks[entry]).cwiseAbs().maxCoeff();
      if (noise == 0.0f) QVERIFY2(off <= 2.0f / 32767.0f, qPrintable(QString::number(off)));
      sum[kinds.kindOf(row.column(entry))] -= row.block(0, entry);
    }
    for (const ColourBlock& left : sum) QVERIFY(left.cwiseAbs().maxCoeff() < 1.0f / 32767.0f);
  }

  /// Where a kind's blocks cancel, what is left of their sum has colours by chance: those of all light count.
  void whatCancelsHasTheColoursOfAll() {
    const ColumnKinds kinds{{{2, 0}, {4, 1}}, 2};
    const ColourBlock light = ColourBlock::Constant(0.3f);
    ColourBlock chance;
    chance << 1.0f, 1.0f, 1.0f, -1.0f, -1.0f, -1.0f, 0.0f, 0.0f, 0.0f;
    const std::vector<ColourBlock> blocks{light, light, 1e-3f * light, -1e-3f * light + 1e-6f * chance};
    const std::vector<std::uint32_t> columns{0, 1, 2, 3};
    SharedColourRow encoded;
    SharedColourEncoder(kinds).encode(columns, blocks, encoded);
    SharedColourWriter writer(4, 1, kinds, 0);
    writer.add(encoded);
    const BlockSparse row = writer.build();
    QCOMPARE(row.blocks(), 4u);
    for (std::size_t entry = 0; entry < row.blocks(); ++entry) {
      const float off = (row.block(0, entry) - blocks[row.column(entry)]).cwiseAbs().maxCoeff();
      QVERIFY2(off < 1e-5f, qPrintable(QString::number(off)));
    }
  }

  void rowsMayBeEmpty() {
    const ColumnKinds kinds = someKinds(12);
    SharedColourWriter writer(12, 3, kinds, 0);
    SharedColourRow encoded;
    SharedColourEncoder encoder(kinds);
    for (int row = 0; row < 3; ++row) {
      encoder.encode({}, {}, encoded);
      writer.add(encoded);
    }
    const BlockSparse blocks = writer.build();
    QCOMPARE(blocks.rows(), 3u);
    QCOMPARE(blocks.multiply(Stack(36, 1.0f)), Stack(9, 0.0f));
    QCOMPARE(blocks.multiplyTransposed(Stack(9, 1.0f)), Stack(36, 0.0f));
  }
};

QTEST_APPLESS_MAIN(TestBlockSparse)
#include "test_block_sparse.moc"
