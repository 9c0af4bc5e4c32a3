// SPDX-License-Identifier: MIT
// What lasts is told from what goes away.
#include "relucent/monitoring/lasting.h"

#include <QtTest>

#include "relucent/base/random.h"

using namespace relucent;
using namespace relucent::monitoring;

class TestLasting : public QObject {
  Q_OBJECT

 private slots:
  /// The median breaks down at half of the weight, no earlier.
  void whatIsThereForLessThanHalfDoesNotShow_data() {
    QTest::addColumn<int>("disturbed");
    QTest::addColumn<bool>("shows");
    QTest::newRow("never") << 0 << false;
    QTest::newRow("two fifths of the time") << 8 << false;
    QTest::newRow("three fifths of the time") << 12 << true;
    QTest::newRow("always") << 20 << true;
  }
  void whatIsThereForLessThanHalfDoesNotShow() {
    QFETCH(int, disturbed);
    QFETCH(bool, shows);
    Lasting lasting({40.0, 15.0, 8, 0.1, 0.005, 0.75, 0.7});
    Random random({1});
    for (int n = 0; n < 20; ++n) {
      // Spread over the window, as visitors are.
      const bool isThere = (n * disturbed) / 20 != ((n + 1) * disturbed) / 20;
      lasting.add(2.0 * n, (isThere ? -0.5 : 0.0) + 0.002 * random.normal(), 0.01);
    }
    QCOMPARE(*lasting.median() < -0.25, shows);
  }

  void fewPhotographsTellNothing() {
    Lasting lasting({40.0, 15.0, 8, 0.1, 0.005, 0.75, 0.7});
    for (int n = 0; n < 7; ++n) lasting.add(4.0 * n, -0.5, 0.01);
    QVERIFY(!lasting.median());
    lasting.add(28.0, -0.5, 0.01);
    QVERIFY(lasting.median());
    Lasting quick({40.0, 15.0, 8, 0.1, 0.005, 0.75, 0.7});
    for (int n = 0; n < 20; ++n) quick.add(0.5 * n, -0.5, 0.01);
    QVERIFY(!quick.median());
  }

  void uncertainPhotographsDoNotCount() {
    Lasting lasting({40.0, 15.0, 8, 0.1, 0.005, 0.75, 0.7});
    for (int n = 0; n < 20; ++n) lasting.add(2.0 * n, n % 2 == 0 ? 0.01 : -0.9, n % 2 == 0 ? 0.01 : 0.2);
    QCOMPARE(*lasting.median(), 0.01);
    for (int n = 20; n < 60; ++n) lasting.add(2.0 * n, -0.9, 0.2);
    QVERIFY2(!lasting.median(), "what was seen before the window counts");
  }

  void aLimitIsHeldByNearlyAll() {
    Lasting lasting({40.0, 15.0, 8, 0.1, 0.005, 0.75, 0.7});
    for (int n = 0; n < 20; ++n) lasting.add(2.0 * n, n < 6 ? 0.0 : -0.05, 0.01);
    QVERIFY(!lasting.holds(0.05, -1));
    lasting.add(40.0, -0.05, 0.01);
    lasting.add(42.0, -0.05, 0.01);
    lasting.add(44.0, -0.05, 0.01);
    QVERIFY(lasting.holds(0.05, -1));
    QVERIFY(!lasting.holds(0.05, 1));
  }

  void whatChangesAllTheTimeIsNotKept() {
    Lasting same({40.0, 15.0, 8, 0.1, 0.005, 0.75, 0.7}), unlike = same;
    for (int n = 0; n < 20; ++n) {
      same.add(2.0 * n, -0.6 + 0.01 * (n % 3), 0.01);
      unlike.add(2.0 * n, n % 2 == 0 ? -0.4 : -0.9, 0.01);
    }
    QVERIFY(same.keeps(0.1) && same.holds(0.3, -1));
    QVERIFY(!unlike.keeps(0.1) && unlike.holds(0.3, -1));
  }

  /// What is off from the beginning is the measurement's, but not all that may be.
  void theFirstMinutesTellTheReference_data() {
    QTest::addColumn<double>("value");
    QTest::addColumn<double>("reference");
    QTest::newRow("as measured") << 0.0 << 0.0;
    QTest::newRow("a little low") << -0.006 << -0.006;
    QTest::newRow("faded before the beginning") << -0.05 << -0.01;
  }
  void theFirstMinutesTellTheReference() {
    QFETCH(double, value);
    QFETCH(double, reference);
    Reference first;
    for (int n = 0; n < 200; ++n) {
      const double seconds = 4.0 * n;
      first.add(seconds, n % 3 == 0 ? -0.5 : value, n % 3 == 0 ? 0.2 : 0.01);
      QCOMPARE(first.value(), seconds < 604.0 ? 0.0 : reference);
    }
    for (int n = 200; n < 400; ++n) first.add(4.0 * n, -0.3, 0.01);
    QCOMPARE(first.value(), reference);
  }
};

QTEST_GUILESS_MAIN(TestLasting)
#include "test_lasting.moc"
