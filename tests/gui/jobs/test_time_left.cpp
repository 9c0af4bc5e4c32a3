// SPDX-License-Identifier: MIT
#include "jobs/time_left.h"

#include <QtTest>

using namespace relucent;
using namespace relucent::gui;
using namespace std::chrono_literals;

class TestTimeLeft : public QObject {
  Q_OBJECT

 private slots:
  void theClockCountsDownAndStandsStillInAPause() {
    TimeLeft left;
    TimeLeft::Moment begin{};
    QVERIFY(!left.seconds(begin));
    WorkLeft work;
    work.seconds = 100.0;
    left.expect(work, begin);
    QCOMPARE(*left.seconds(begin + 30s), 70.0);
    left.pause(begin + 30s);
    QCOMPARE(*left.seconds(begin + 500s), 70.0);
    left.resume(begin + 500s);
    QCOMPARE(*left.seconds(begin + 510s), 60.0);
    QCOMPARE(*left.seconds(begin + 5000s), 0.0);
  }

  void durationsAreRoundedUp_data() {
    QTest::addColumn<double>("seconds");
    QTest::addColumn<QString>("text");
    QTest::newRow("nothing") << 0.0 << "10 s";
    QTest::newRow("seconds") << 31.0 << "40 s";
    QTest::newRow("nearly a minute") << 55.0 << "1 min";
    QTest::newRow("minutes") << 61.0 << "2 min";
    QTest::newRow("hours") << 7500.0 << "2 h 5 min";
  }
  void durationsAreRoundedUp() {
    QFETCH(double, seconds);
    QFETCH(QString, text);
    QCOMPARE(durationText(seconds), text);
  }
};

QTEST_GUILESS_MAIN(TestTimeLeft)
#include "test_time_left.moc"
