// SPDX-License-Identifier: MIT
#include "output/night_schedule.h"

#include <QtTest>

using namespace relucent::gui;

class TestNightSchedule : public QObject {
  Q_OBJECT

  static QDateTime at(const char* time, int day = 4) {
    return {{2026, 5, day}, QTime::fromString(time, "HH:mm")};
  }

 private slots:
  void theTimeIsOutsideTheHours_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("hours");
    QTest::addColumn<QTime>("time");
    QTest::newRow("a time") << "03:00"
                            << "" << QTime(3, 0);
    QTest::newRow("after the hours") << "after"
                                     << "09:00-17:30" << QTime(17, 30);
    QTest::newRow("after those of a night") << "after"
                                            << "18:00-02:30" << QTime(2, 30);
    QTest::newRow("at their end") << "17:30"
                                  << "09:00-17:30" << QTime(17, 30);
    QTest::newRow("after none") << "after"
                                << "" << QTime();
    QTest::newRow("within them") << "12:00"
                                 << "09:00-17:30" << QTime();
    QTest::newRow("within those of a night") << "01:00"
                                             << "18:00-02:30" << QTime();
    QTest::newRow("no time") << "25:00"
                             << "" << QTime();
    QTest::newRow("nothing") << ""
                             << "" << QTime();
  }
  void theTimeIsOutsideTheHours() {
    QFETCH(QString, text);
    QFETCH(QString, hours);
    QFETCH(QTime, time);
    const auto found = nightTimeFrom(text, hours.isEmpty() ? std::nullopt : dailyHoursFrom(hours));
    QCOMPARE(found.has_value(), time.isValid());
    if (found) QCOMPARE(*found, time);
  }

  /// Law: there is one night a day, and from one due time to the next nothing is due twice.
  void oneADay() {
    const NightSchedule schedule({3, 0}, std::nullopt);
    QDateTime last = schedule.dueBefore(at("00:00"));
    int nights = 0;
    for (int minute = 0; minute < 10 * 24 * 60; minute += 7) {
      const QDateTime now = at("00:00").addSecs(60 * minute), due = schedule.dueBefore(now);
      QVERIFY(due <= now && schedule.dueAfter(now) > now);
      QVERIFY(due >= last);
      nights += due > last;
      last = due;
    }
    QCOMPARE(nights, 10);
  }

  void beginsWithinItsDelayAndInTheDark_data() {
    QTest::addColumn<QString>("hours");
    QTest::addColumn<QTime>("at");
    QTest::addColumn<QDateTime>("now");
    QTest::addColumn<bool>("may");
    const auto row = [](const char* name, const char* hours, QTime due, const QDateTime& now, bool may) {
      QTest::newRow(name) << QString(hours) << due << now << may;
    };
    row("on time", "", {3, 0}, at("03:00"), true);
    row("an hour late", "", {3, 0}, at("04:00"), true);
    row("too late", "", {3, 0}, at("05:00"), false);
    row("over midnight", "", {23, 30}, at("00:30", 5), true);
    row("after the hours", "09:00-17:30", {17, 30}, at("17:30"), true);
    row("the hours have begun", "04:00-17:30", {3, 0}, at("04:00"), false);
  }
  void beginsWithinItsDelayAndInTheDark() {
    QFETCH(QString, hours);
    QFETCH(QTime, at);
    QFETCH(QDateTime, now);
    QFETCH(bool, may);
    const NightSchedule schedule(at, hours.isEmpty() ? std::nullopt : dailyHoursFrom(hours));
    QCOMPARE(schedule.mayBegin(schedule.dueBefore(now), now), may);
  }

  void endsWhereTheShowBegins() {
    const NightSchedule within({3, 0}, dailyHoursFrom("04:00-17:30")), always({3, 0}, std::nullopt);
    QVERIFY(!within.mustEnd(at("03:00"), at("03:59")) && within.mustEnd(at("03:00"), at("04:00")));
    QVERIFY(!always.mustEnd(at("03:00"), at("08:59")) && always.mustEnd(at("03:00"), at("09:00")));
  }
};

QTEST_GUILESS_MAIN(TestNightSchedule)
#include "test_night_schedule.moc"
