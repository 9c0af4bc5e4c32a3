// SPDX-License-Identifier: MIT
#include <tbb/global_control.h>

#include <QtTest>
#include <set>

#include "relucent/acquisition/schedule.h"
#include "relucent/base/random.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::transport;

namespace {

/// Pairs of camera pixels and nodes in [first, first + nodes): each row sees up to `most` neighbouring nodes.
BlockSparse randomPairs(std::size_t rows, std::size_t first, std::size_t nodes, std::size_t most,
                        std::uint64_t seed) {
  Random random{seed};
  BlockSparseBuilder builder(first + nodes, std::vector<float>(rows, 1.0f));
  for (std::size_t row = 0; row < rows; ++row) {
    std::size_t count = random.below(most + 1);
    std::size_t place = random.below(nodes);
    for (std::size_t i = 0; i < count; ++i)
      builder.add(row, first + (place + random.below(2 * most)) % nodes, ColourBlock::Ones() / 64.0f);
  }
  return builder.build();
}

std::size_t mostInARow(const BlockSparse& pairs) {
  std::size_t most = 0;
  for (std::size_t row = 0; row < pairs.rows(); ++row)
    most = std::max(most, pairs.rowBegin(row + 1) - pairs.rowBegin(row));
  return most;
}

}  // namespace

class TestSchedule : public QObject {
  Q_OBJECT

 private slots:
  void pairs_data() {
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("nodes");
    QTest::addColumn<int>("most");
    QTest::newRow("nothing") << 10 << 4 << 0;
    QTest::newRow("one node") << 10 << 1 << 1;
    QTest::newRow("sparse") << 500 << 300 << 3;
    QTest::newRow("dense") << 500 << 60 << 20;
    QTest::newRow("more colours than a word has bits") << 50 << 400 << 150;
  }

  void noCameraPixelSeesTwoBlocksOfAColour_data() { pairs_data(); }
  void noCameraPixelSeesTwoBlocksOfAColour() {
    QFETCH(int, rows);
    QFETCH(int, nodes);
    QFETCH(int, most);
    std::size_t first = 7;
    BlockSparse pairs = randomPairs(static_cast<std::size_t>(rows), first, static_cast<std::size_t>(nodes),
                                    static_cast<std::size_t>(most), 1);
    Schedule plan = schedule(pairs, first, static_cast<std::size_t>(nodes));
    std::set<std::size_t> seen;
    for (std::size_t row = 0; row < pairs.rows(); ++row) {
      std::set<std::uint32_t> colours;
      for (std::size_t entry = pairs.rowBegin(row); entry < pairs.rowBegin(row + 1); ++entry) {
        std::uint32_t colour = plan.colour(pairs.column(entry));
        QVERIFY(colour < plan.colours);
        QVERIFY2(colours.insert(colour).second,
                 qPrintable(QString("row %1 sees colour %2 twice").arg(row).arg(colour)));
        seen.insert(pairs.column(entry));
      }
    }
    for (std::size_t node = first; node < first + static_cast<std::size_t>(nodes); ++node)
      QCOMPARE(plan.colour(node) == Schedule::dark, !seen.contains(node));
    // No schedule can do with fewer colours than a camera pixel sees blocks.
    QVERIFY(plan.colours >= mostInARow(pairs));
  }

  void blocksThatNobodySeesTogetherShareOneFrame() {
    BlockSparseBuilder builder(100, std::vector<float>(100, 1.0f));
    for (std::size_t row = 0; row < 100; ++row) builder.add(row, row, ColourBlock::Ones());
    QCOMPARE(schedule(builder.build(), 0, 100).colours, 1u);
  }

  /// A chain of overlapping pairs needs two colours; greedy colouring in an unlucky order takes one more.
  void chainsNeedAtMostThreeColours() {
    BlockSparseBuilder builder(101, std::vector<float>(100, 1.0f));
    for (std::size_t row = 0; row < 100; ++row) {
      builder.add(row, row * 37 % 101, ColourBlock::Ones());
      builder.add(row, (row * 37 + 37) % 101, ColourBlock::Ones());
    }
    QVERIFY(schedule(builder.build(), 0, 101).colours <= 3u);
  }

  void theScheduleIsTheSameForEveryNumberOfThreads() {
    BlockSparse pairs = randomPairs(2000, 0, 500, 12, 2);
    Schedule plan = schedule(pairs, 0, 500);
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    QVERIFY(schedule(pairs, 0, 500).colourOf == plan.colourOf);
  }
};

QTEST_APPLESS_MAIN(TestSchedule)
#include "test_schedule.moc"
