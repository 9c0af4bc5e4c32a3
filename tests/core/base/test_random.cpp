// SPDX-License-Identifier: MIT
#include <QtTest>
#include <set>
#include <vector>

#include "relucent/base/random.h"

using namespace relucent;

class TestRandom : public QObject {
  Q_OBJECT

 private slots:
  void itIsTheSameEverywhere() {
    // Shots taken again and caches of traced venues rest on these numbers.
    Random random{1, 2, 3};
    QCOMPARE(random.next(), quint64(0x214d4c07ecfeaac5));
    QCOMPARE(random.next(), quint64(0x6ff419cb83dfe1e6));
  }

  void sameKeysSameNumbers() {
    Random first{4, 5}, second{4, 5};
    for (int i = 0; i < 100; ++i) {
      QCOMPARE(first.next(), second.next());
      QCOMPARE(first.normal(), second.normal());
    }
  }

  void otherKeysOtherNumbers() {
    std::set<std::uint64_t> seen;
    for (std::uint64_t a = 0; a < 20; ++a) {
      seen.insert(Random{a}.next());
      for (std::uint64_t b = 0; b < 20; ++b) seen.insert(Random{a, b}.next());
    }
    QCOMPARE(seen.size(), std::size_t{420});
  }

  void uniformNumbersFillTheirRange() {
    Random random{6};
    const int count = 100000;
    std::vector<int> bins(10);
    double sum = 0;
    for (int i = 0; i < count; ++i) {
      const double value = random.uniform();
      QVERIFY(value >= 0.0 && value < 1.0);
      const float single = random.uniformFloat();
      QVERIFY(single >= 0.0f && single < 1.0f);
      sum += value;
      ++bins[static_cast<std::size_t>(value * 10.0)];
    }
    // Five standard deviations: of the mean of uniform numbers, and of a bin of a tenth of them.
    QVERIFY(std::abs(sum / count - 0.5) < 5.0 * std::sqrt(1.0 / 12.0 / count));
    for (int bin : bins) QVERIFY(std::abs(bin - count / 10) < 5.0 * std::sqrt(count * 0.1 * 0.9));
  }

  void normalNumbersHaveTheirMoments() {
    Random random{7};
    const int count = 100000;
    double sum = 0, squares = 0, fourths = 0;
    for (int i = 0; i < count; ++i) {
      const double value = random.normal();
      sum += value;
      squares += value * value;
      fourths += value * value * value * value;
    }
    // Moments 0, 1, 3; the variances of their estimates are 1, 2 and 96 over the count. Five deviations.
    QVERIFY(std::abs(sum / count) < 5.0 * std::sqrt(1.0 / count));
    QVERIFY(std::abs(squares / count - 1.0) < 5.0 * std::sqrt(2.0 / count));
    QVERIFY(std::abs(fourths / count - 3.0) < 5.0 * std::sqrt(96.0 / count));
  }

  void belowStaysBelow_data() {
    QTest::addColumn<quint64>("limit");
    QTest::newRow("one") << quint64{1};
    QTest::newRow("three") << quint64{3};
    QTest::newRow("large") << quint64{1} + (quint64{1} << 63);
  }
  void belowStaysBelow() {
    QFETCH(quint64, limit);
    Random random{8};
    std::set<std::uint64_t> seen;
    for (int i = 0; i < 1000; ++i) {
      const std::uint64_t value = random.below(limit);
      QVERIFY(value < limit);
      seen.insert(value);
    }
    QCOMPARE(seen.size(), static_cast<std::size_t>(std::min<quint64>(limit, 1000)));
  }
};

QTEST_APPLESS_MAIN(TestRandom)
#include "test_random.moc"
