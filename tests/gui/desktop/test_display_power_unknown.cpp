// SPDX-License-Identifier: MIT
// Runs without an X server.
#include <QtTest>

#include "desktop/display_power.h"

using namespace relucent;
using namespace relucent::gui;

class TestDisplayPowerUnknown : public QObject {
  Q_OBJECT

 private slots:
  void whereNobodyCanBeAskedItSaysSo() {
    DisplayPower power;
    QVERIFY(power.state() == DisplayPower::State::unknown);
    QVERIFY(power.problem().contains("no X server"));
    power.keepAwake();
    power.wake();
    QVERIFY(!power.hasSlept());
  }
};

QTEST_MAIN(TestDisplayPowerUnknown)
#include "test_display_power_unknown.moc"
