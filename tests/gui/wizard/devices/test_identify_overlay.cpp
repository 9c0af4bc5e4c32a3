// SPDX-License-Identifier: MIT
#include "wizard/devices/identify_overlay.h"

#include <QTimer>
#include <QWidget>
#include <QtTest>

using namespace relucent::gui;

class TestIdentifyOverlay : public QObject {
  Q_OBJECT

  static constexpr int patience = 20'000;  // milliseconds

 private slots:
  /// The program ends with its last window: cards must not keep it, nor take the end away with them.
  void aClosedWindowIsTheEnd_data() {
    QTest::addColumn<bool>("isOffered");
    QTest::newRow("with the page that offers it") << true;
    QTest::newRow("by itself") << false;
  }
  void aClosedWindowIsTheEnd() {
    QFETCH(bool, isOffered);
    QWidget window;
    IdentifyOverlay overlay(isOffered ? &window : nullptr);
    window.show();
    overlay.show();
    QVERIFY(QTest::qWaitForWindowExposed(&window) && overlay.isShown());
    bool goesWithIt = false;
    QTimer::singleShot(0, &window, [&] {
      window.close();
      goesWithIt = !overlay.isShown();
      overlay.hide();
    });
    QTimer::singleShot(patience, &window, [] { qApp->exit(1); });
    QCOMPARE(qApp->exec(), 0);
    QCOMPARE(goesWithIt, isOffered);
  }

  void itGoesWithItsPage() {
    QWidget window;
    auto* page = new QWidget(&window);
    IdentifyOverlay overlay(page);
    window.show();
    overlay.show();
    page->hide();
    QVERIFY(!overlay.isShown());
  }
};

QTEST_MAIN(TestIdentifyOverlay)
#include "test_identify_overlay.moc"
