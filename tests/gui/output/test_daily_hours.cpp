// SPDX-License-Identifier: MIT
#include <QtTest>

#include "output/daily_hours.h"
#include "output/machine_clock.h"

using namespace relucent;
using namespace relucent::gui;

class TestDailyHours : public QObject {
  Q_OBJECT

 private slots:
  void sayWhetherItIsTime_data() {
    QTest::addColumn<QString>("hours");
    QTest::addColumn<QString>("in");
    QTest::addColumn<QString>("out");
    QTest::newRow("day") << "09:00-17:30"
                         << "09:00 12:00 17:29"
                         << "08:59 17:30 23:00 00:00";
    QTest::newRow("over midnight") << "18:00-02:30"
                                   << "18:00 23:59 00:00 02:29"
                                   << "02:30 12:00 17:59";
    QTest::newRow("until midnight") << "20:00-0:00"
                                    << "20:00 23:59"
                                    << "00:00 19:59";
    QTest::newRow("one minute") << " 7:05 - 7:06 "
                                << "07:05"
                                << "07:04 07:06";
  }
  void sayWhetherItIsTime() {
    QFETCH(QString, hours);
    QFETCH(QString, in);
    QFETCH(QString, out);
    auto read = dailyHoursFrom(hours);
    QVERIFY(read);
    for (const QString& time : in.split(' '))
      QVERIFY2(read->contain(QTime::fromString(time)), qPrintable(time));
    for (const QString& time : out.split(' '))
      QVERIFY2(!read->contain(QTime::fromString(time)), qPrintable(time));
  }

  void whatIsNoHoursIsRefused() {
    for (const char* wrong : {"", "9-17", "09:00", "09:00-", "-17:00", "09:00-24:00", "09:60-17:00",
                              "09:00-09:00", "09:00-12:00-17:00", "nine-five"})
      QVERIFY2(!dailyHoursFrom(wrong), wrong);
  }

  void theMachinesSleepIsNoNegativeTime() {
    auto slept = MachineClock{}.slept();
    // The two clocks are read one after the other.
    QVERIFY(slept > -std::chrono::milliseconds(100));
    QVERIFY(MachineClock{}.slept() - slept < std::chrono::seconds(1));
  }
};

QTEST_GUILESS_MAIN(TestDailyHours)
#include "test_daily_hours.moc"
