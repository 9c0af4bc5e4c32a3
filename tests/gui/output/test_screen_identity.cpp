// SPDX-License-Identifier: MIT
#include <QtTest>

#include "output/screen_identity.h"

using namespace relucent;
using namespace relucent::gui;

class TestScreenIdentity : public QObject {
  Q_OBJECT

 private slots:
  void scaledDesktopsHideNoPixel_data() {
    QTest::addColumn<int>("length");
    for (int length : {768, 800, 1024, 1050, 1080, 1200, 1366, 1600, 1920, 2160, 2560, 3840, 4096})
      QTest::addRow("%d", length) << length;
  }
  void scaledDesktopsHideNoPixel() {
    QFETCH(int, length);
    for (double ratio : {1.0, 1.25, 1.5, 1.75, 2.0})
      QCOMPARE(nativeLength(qRound(length / ratio), ratio), length);
  }

  void theWantedDisplayIsFoundOrNone_data() {
    ScreenIdentity laptop{"eDP-1", "AUO", "B140", ""};
    ScreenIdentity wanted{"HDMI-1", "EPS", "L1755", "4711"};
    ScreenIdentity moved{"DP-3", "EPS", "L1755", "4711"};
    ScreenIdentity twin{"HDMI-2", "EPS", "L1755", "4712"};
    ScreenIdentity mute{"HDMI-1", "EPS", "L1755", ""}, muteTwin{"HDMI-2", "EPS", "L1755", ""};
    ScreenIdentity nameless{"DUMMY1", "", "", ""}, namelessOther{"DUMMY2", "", "", ""};
    ScreenIdentity copied{"HDMI-2", "EPS", "L1755", "4711"};
    QTest::addColumn<ScreenIdentity>("wanted");
    QTest::addColumn<QList<ScreenIdentity>>("present");
    QTest::addColumn<int>("found");
    auto row = [](const char* name, const ScreenIdentity& w, const QList<ScreenIdentity>& p, int found) {
      QTest::newRow(name) << w << p << found;
    };
    row("nothing there", wanted, {}, -1);
    row("only the operator's", wanted, {laptop}, -1);
    row("where it was", wanted, {laptop, wanted}, 1);
    row("on another connector", wanted, {laptop, moved}, 1);
    row("its twin on its connector is not it", wanted, {laptop, {"HDMI-1", "EPS", "L1755", "4712"}}, -1);
    row("beside its twin", wanted, {twin, laptop, moved}, 2);
    row("two with one serial number: the connector decides", wanted, {copied, wanted, laptop}, 1);
    row("two with one serial number, both elsewhere", wanted, {copied, moved}, -1);
    row("no serial number: on its connector", mute, {laptop, muteTwin, mute}, 2);
    row("no serial number: not on another one", mute, {laptop, muteTwin}, -1);
    row("tells nothing", nameless, {namelessOther, nameless}, 1);
    row("tells nothing, another one is there", nameless, {namelessOther}, -1);
  }
  void theWantedDisplayIsFoundOrNone() {
    QFETCH(ScreenIdentity, wanted);
    QFETCH(QList<ScreenIdentity>, present);
    QFETCH(int, found);
    QCOMPARE(static_cast<int>(findScreen(wanted, present).value_or(-1)), found);
  }

  void isKeptInFiles() {
    ScreenIdentity identity{"HDMI-1", "EPS", "Ludwig \"XL\"", "4711"};
    QVERIFY(screenIdentityFrom(toJson(identity)) == identity);
    QVERIFY(screenIdentityFrom({}) == ScreenIdentity{});
  }
};

QTEST_APPLESS_MAIN(TestScreenIdentity)
#include "test_screen_identity.moc"
