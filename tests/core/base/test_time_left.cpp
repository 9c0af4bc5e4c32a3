// SPDX-License-Identifier: MIT
#include "relucent/base/time_left.h"

#include <QtTest>
#include <cmath>

using namespace relucent;
using namespace std::chrono_literals;

namespace {

TimeLeft::Moment at(double seconds) {
  return TimeLeft::Moment(
      std::chrono::duration_cast<TimeLeft::Moment::duration>(std::chrono::duration<double>(seconds)));
}

}  // namespace

class TestTimeLeft : public QObject {
  Q_OBJECT

 private slots:
  void theClockCountsDownAndStandsStillInAPause() {
    TimeLeft left;
    TimeLeft::Moment begin{};
    QVERIFY(!left.seconds(begin));
    left.expect(begin, 100.0);
    QCOMPARE(*left.seconds(begin + 30s), 70.0);
    left.pause(begin + 30s);
    QCOMPARE(*left.seconds(begin + 500s), 70.0);
    left.resume(begin + 500s);
    QCOMPARE(*left.seconds(begin + 510s), 60.0);
    QCOMPARE(*left.seconds(begin + 5000s), 0.0);
  }

  /// A pause is no slow work.
  void aPauseDoesNotChangeTheRate() {
    TimeLeft left;
    for (int t = 0; t <= 10; ++t) left.add(at(t), t / 100.0);
    left.pause(at(10.0));
    left.resume(at(600.0));
    left.add(at(601.0), 0.11);
    QVERIFY2(std::abs(*left.seconds(at(601.0)) - 89.0) < 1e-6, QByteArray::number(*left.seconds(at(601.0))));
  }

  /// What was read from the journal went by at once; half a minute later only the true rate counts.
  void aResumedStartIsForgotten() {
    TimeLeft left;
    left.add(at(0.0), 0.0);
    left.add(at(0.1), 0.5);
    for (double t = 1.0; t <= 60.0; t += 0.5) left.add(at(t), 0.5 + t / 2000.0);
    // From 0.53 on 0.47 are left, at 1/2000 a second: 940 s. The window is kept to one sample's distance.
    double seconds = *left.seconds(at(60.0));
    QVERIFY2(std::abs(seconds - 940.0) < 10.0, QByteArray::number(seconds));
  }

  void durationsAreAsExactAsTheyAreKnown_data() {
    QTest::addColumn<double>("seconds");
    QTest::addColumn<QString>("expected");
    QTest::addColumn<QString>("spent");
    QTest::newRow("nothing") << 0.0 << "under a minute"
                             << "1 s";
    QTest::newRow("a second and a half") << 1.38 << "under a minute"
                                         << "1 s";
    QTest::newRow("seconds") << 31.2 << "under a minute"
                             << "31 s";
    QTest::newRow("nearly a minute") << 59.9 << "under a minute"
                                     << "60 s";
    QTest::newRow("a minute") << 60.0 << "1 min"
                              << "60 s";
    QTest::newRow("more than a minute") << 61.0 << "2 min"
                                        << "61 s";
    QTest::newRow("minutes") << 140.0 << "3 min"
                             << "2 min";
    QTest::newRow("an hour") << 3600.0 << "60 min"
                             << "60 min";
    QTest::newRow("hours") << 7500.0 << "2 h 5 min"
                           << "2 h 5 min";
  }
  /// Of what is to come nobody knows seconds; what was taken was counted.
  void durationsAreAsExactAsTheyAreKnown() {
    QFETCH(double, seconds);
    QFETCH(QString, expected);
    QFETCH(QString, spent);
    QCOMPARE(QString::fromStdString(english(expectedDuration(seconds))), expected);
    QCOMPARE(QString::fromStdString(english(spentDuration(seconds))), spent);
    QCOMPARE(isUnderAMinute(seconds), expected == "under a minute");
  }
};

QTEST_APPLESS_MAIN(TestTimeLeft)
#include "test_time_left.moc"
