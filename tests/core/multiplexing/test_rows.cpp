// SPDX-License-Identifier: MIT
#include <QtTest>
#include <stdexcept>

#include "relucent/base/parallel.h"
#include "relucent/multiplexing/rows.h"

using namespace relucent;
using namespace relucent::multiplexing;

namespace {

/// A row of its own for every number, some without leaves.
Row rowFor(std::size_t number) {
  Row row;
  for (std::size_t leaf = 0; leaf < number % 5; ++leaf)
    row.leaves.push_back({static_cast<std::uint32_t>(7 * number + leaf), 0.0f, 0.5f,
                          static_cast<float>(number % 101) / 128.0f, 0.25f});
  for (int kind = 0; kind < 2; ++kind)
    row.mixing.push_back(transport::ColourBlock::Constant(static_cast<float>(number) + 0.5f * kind));
  row.excess = static_cast<float>(number % 13);
  return row;
}

bool alike(const Row& a, const Row& b) {
  return a.mixing == b.mixing && a.excess == b.excess &&
         std::ranges::equal(a.leaves, b.leaves, [](const Leaf& p, const Leaf& q) {
           return p.node == q.node && p.light == q.light && p.deviation == q.deviation &&
                  p.expected == q.expected && p.spread == q.spread;
         });
}

Rows filled(std::size_t count) {
  Rows rows(count, 2);
  rows.change([&](std::size_t row, std::vector<Leaf>& leaves) { leaves = rowFor(row).leaves; });
  parallelFor(0, count, 64, [&](std::size_t row) { rows.write(row, rowFor(row)); });
  return rows;
}

}  // namespace

class TestRows : public QObject {
  Q_OBJECT

 private slots:
  void everyRowIsItsOwn_data() {
    QTest::addColumn<int>("count");
    const int block = static_cast<int>(Rows::rowsOfBlock);
    for (int count : {0, 1, 300, block, block + 1, 2 * block + 7}) QTest::addRow("%d rows", count) << count;
  }
  void everyRowIsItsOwn() {
    QFETCH(int, count);
    const Rows rows = filled(static_cast<std::size_t>(count));
    QCOMPARE(rows.size(), static_cast<std::size_t>(count));
    Row row;
    std::size_t leaves = 0, wrong = 0;
    for (std::size_t number = 0; number < rows.size(); ++number) {
      rows.read(number, row);
      leaves += row.leaves.size();
      wrong += alike(row, rowFor(number)) ? 0 : 1;
    }
    QCOMPARE(wrong, std::size_t{0});
    QCOMPARE(rows.leaves(), leaves);
  }

  /// What a row becomes may depend on what it was, mixings stay.
  void leavesAreExchanged() {
    Rows rows = filled(Rows::rowsOfBlock + 10);
    rows.change([&](std::size_t row, std::vector<Leaf>& leaves) {
      for (const Leaf& leaf : rows.leavesOf(row)) leaves.insert(leaves.end(), 2, leaf);
    });
    for (std::size_t number : {std::size_t{4}, Rows::rowsOfBlock - 1, Rows::rowsOfBlock + 9}) {
      Row wanted = rowFor(number), row;
      std::vector<Leaf> twice;
      for (const Leaf& leaf : wanted.leaves) twice.insert(twice.end(), 2, leaf);
      wanted.leaves = twice;
      rows.read(number, row);
      QVERIFY(alike(row, wanted));
    }
  }

  void whatIsDoneWithIsForgotten() {
    Rows rows = filled(2 * Rows::rowsOfBlock + 5);
    Row row;
    rows.forgetBefore(2 * Rows::rowsOfBlock - 1);
    QVERIFY(rows.leavesOf(4).empty());
    rows.read(Rows::rowsOfBlock + 4, row);
    QVERIFY(alike(row, rowFor(Rows::rowsOfBlock + 4)));
    rows.forgetBefore(2 * Rows::rowsOfBlock + 5);
    QVERIFY(rows.leavesOf(Rows::rowsOfBlock + 4).empty());
    rows.read(2 * Rows::rowsOfBlock + 4, row);
    QVERIFY(alike(row, rowFor(2 * Rows::rowsOfBlock + 4)));
  }

  void aRowOfAnotherLengthIsRefused() {
    Rows rows = filled(10);
    QVERIFY_THROWS_EXCEPTION(std::logic_error, rows.write(3, rowFor(4)));
  }
};

QTEST_MAIN(TestRows)
#include "test_rows.moc"
