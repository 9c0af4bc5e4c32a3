// SPDX-License-Identifier: MIT
// Runs on an X server of its own, see tests/support/with-two-screens.
#include "desktop/display_power.h"

#include <QElapsedTimer>
#include <QtTest>

#include "gui/output/two_screens.h"

using namespace relucent;
using namespace relucent::gui;
using State = DisplayPower::State;

class TestDisplayPower : public QObject {
  Q_OBJECT

 private slots:
  void cleanup() {
    xset({"s", "default"});
    xset({"s", "reset"});
    if (!whyNoSleep({"dpms"}).isEmpty()) return;
    xset({"dpms", "force", "on"});
    xset({"dpms", "600", "600", "600"});
  }

  void displaysAreAwakeToBeginWith() {
    DisplayPower power;
    QVERIFY(power.state() == State::awake);
    QVERIFY(power.problem().isEmpty() && !power.hasSlept());
  }

  void sleepIsSeenAndEnded_data() { addWaysToSleep(); }
  void sleepIsSeenAndEnded() {
    QFETCH(QStringList, sleep);
    if (QString why = whyNoSleep(sleep); !why.isEmpty()) QSKIP(qPrintable(why));
    DisplayPower power;
    xset(sleep);
    QVERIFY(power.state() == State::asleep && power.hasSlept());
    power.wake();
    QVERIFY(power.state() == State::awake && !power.hasSlept());
  }

  void aSleepBetweenTwoQuestionsIsNoticed_data() { addWaysToSleep(); }
  void aSleepBetweenTwoQuestionsIsNoticed() {
    QFETCH(QStringList, sleep);
    QFETCH(QStringList, wake);
    if (QString why = whyNoSleep(sleep); !why.isEmpty()) QSKIP(qPrintable(why));
    DisplayPower power;
    xset(sleep);
    xset(wake);
    QVERIFY(power.state() == State::awake);
    QVERIFY(power.hasSlept());
    QVERIFY(!power.hasSlept());
  }

  /// The server's own clock, which sends displays to sleep where no desktop does.
  void whatIsKeptAwakeStaysAwakeAndNoLonger_data() {
    QTest::addColumn<QStringList>("timeout");
    QTest::newRow("screen saver") << QStringList{"s", "1", "1"};
    QTest::newRow("DPMS") << QStringList{"dpms", "1", "1", "1"};
  }
  void whatIsKeptAwakeStaysAwakeAndNoLonger() {
    QFETCH(QStringList, timeout);
    if (QString why = whyNoSleep(timeout); !why.isEmpty()) QSKIP(qPrintable(why));
    DisplayPower watcher;
    {
      DisplayPower keeper;
      keeper.keepAwake();
      QVERIFY(keeper.state() == State::awake);  // the server has heard it
      xset(timeout);
      QElapsedTimer since;
      since.start();
      QTRY_VERIFY(since.hasExpired(1500));  // of the server's time, which nobody else can make pass
      QVERIFY(!watcher.hasSlept());
    }
    QTRY_VERIFY(watcher.state() == State::asleep);
  }
};

QTEST_MAIN(TestDisplayPower)
#include "test_display_power.moc"
