// SPDX-License-Identifier: MIT
#include "wizard/acquire/photograph_rate.h"

#include <QtTest>

using namespace relucent::gui;
using namespace std::chrono_literals;

class TestPhotographRate : public QObject {
  Q_OBJECT

 private slots:
  /// Law: what comes evenly has its rate, whenever it is asked for.
  void evenPhotographsHaveTheirRate() {
    PhotographRate rate;
    const PhotographRate::Clock::time_point start{};
    for (int second = 0; second < 120; ++second) {
      rate.add(start + second * 1s, 2 * second);
      if (second < 5)
        QVERIFY(!rate.perMinute());
      else
        QCOMPARE(*rate.perMinute(), 120.0);
    }
  }

  /// Law: only the last half minute counts, and what was held up does not.
  void itIsOfNow() {
    PhotographRate rate;
    PhotographRate::Clock::time_point now{};
    int photographs = 0;
    for (int second = 0; second < 60; ++second) rate.add(now += 1s, photographs += 10);
    for (int second = 0; second < 35; ++second) rate.add(now += 1s, ++photographs);
    QVERIFY(std::abs(*rate.perMinute() - 60.0) < 1.0);
    rate.forget();
    QVERIFY(!rate.perMinute());
    rate.add(now += 1s, photographs);
    rate.add(now += 10s, photographs + 5);
    QCOMPARE(*rate.perMinute(), 30.0);
    rate.add(now += 1s, 0);  // another measurement
    QVERIFY(!rate.perMinute());
  }
};

QTEST_APPLESS_MAIN(TestPhotographRate)
#include "test_photograph_rate.moc"
