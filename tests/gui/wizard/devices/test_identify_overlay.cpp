// SPDX-License-Identifier: MIT
#include "wizard/devices/identify_overlay.h"

#include <QTimer>
#include <QWidget>
#include <QtTest>

using namespace relucent::gui;

class TestIdentifyOverlay : public QObject {
  Q_OBJECT

  static constexpr int patience = 20'000;              // milliseconds
  static constexpr int lineEvery = 10, lastLine = 20;  // pixels from the edge

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

  /// Law: the lines at the edge show what is cut off: between them nothing is written, whatever the shape of
  /// the screen.
  void linesAtTheEdgeStandAlone() {
    IdentifyOverlay overlay;
    overlay.show();
    int seen = 0;
    for (QWindow* window : QGuiApplication::topLevelWindows()) {
      QVERIFY(QTest::qWaitForWindowExposed(window));
      const QImage picture = window->screen()->grabWindow(window->winId()).toImage();
      QCOMPARE(picture.size(), window->screen()->size());
      for (int inset = 0; inset <= lastLine; ++inset) {
        const QRect ring = picture.rect().adjusted(inset, inset, -inset, -inset);
        const QRgb wanted = picture.pixel(inset % lineEvery == 0 ? QPoint(0, 0) : QPoint(1, 1));
        for (int x = ring.left() + 1; x < ring.right(); ++x)
          for (int y : {ring.top(), ring.bottom()})
            if (x > lastLine && x < picture.width() - lastLine) QCOMPARE(picture.pixel(x, y), wanted);
        for (int y = lastLine + 1; y < picture.height() - lastLine; ++y)
          for (int x : {ring.left(), ring.right()}) QCOMPARE(picture.pixel(x, y), wanted);
      }
      ++seen;
    }
    QCOMPARE(seen, QGuiApplication::screens().size() - 1);
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
