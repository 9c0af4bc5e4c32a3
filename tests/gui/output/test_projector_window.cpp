// SPDX-License-Identifier: MIT
// Runs on two screens that can be unplugged, see tests/support/with-two-screens.
#include <QSignalSpy>
#include <QtTest>

#include "gui/output/scripted_renderer.h"
#include "gui/output/two_screens.h"
#include "output/projector_window.h"

using namespace relucent;
using namespace relucent::gui;

/// With OpenGL and without: see CMakeLists.txt.
class TestProjectorWindow : public QObject {
  Q_OBJECT

  static bool hasOpenGl() { return qEnvironmentVariable("QT_XCB_GL_INTEGRATION") != "none"; }

 private slots:
  void cleanup() {
    if (screenOn("DUMMY1") == nullptr) plug();
  }

  void everyPixelArrivesOnItsDisplayAlone() {
    QImage operatorsBefore = seenOn("DUMMY0");
    ProjectorWindow window(projector);
    QCOMPARE(window.displaySize(), QSize(1024, 768));
    window.shine();
    QTRY_VERIFY(window.isExposed() && window.isShining());
    for (quint32 seed : {1u, 2u, 3u}) {
      QImage picture = noise({1024, 768}, seed);
      window.present(picture);
      QTRY_VERIFY(seenOn("DUMMY1") == picture);
    }
    QVERIFY(seenOn("DUMMY0") == operatorsBefore);
  }

  void isDrawnWithWhatThereIs() {
    ProjectorWindow window(projector);
    QCOMPARE(window.surface().name(), QString(hasOpenGl() ? "OpenGL" : "memory"));
    QCOMPARE(window.surface().keepsStep(), hasOpenGl());
  }

  void whatIsSwappedWasPresentedLast() {
    ProjectorWindow window(projector);
    window.shine();
    QTRY_VERIFY(window.isExposed());
    quint32 presented = 0;
    int swaps = 0, wrong = 0;
    connect(&window, &ProjectorWindow::frameSwapped, &window, [&] {
      ++swaps;
      wrong += presented > 0 && seenOn("DUMMY1") != noise({1024, 768}, presented);
    });
    QTimer presenting;
    connect(&presenting, &QTimer::timeout, &window, [&] { window.present(noise({1024, 768}, ++presented)); });
    presenting.start(7);  // now before a swap, now after it
    QTRY_VERIFY(presented >= 30);
    presenting.stop();
    QTRY_VERIFY(seenOn("DUMMY1") == noise({1024, 768}, presented));
    int before = swaps;
    window.update();
    QTRY_VERIFY(swaps > before);
    QCOMPARE(wrong, 0);
  }

  /// Without OpenGL nobody waits for the display but the window itself.
  void isNotDrawnMoreOftenThanTheDisplayShowsIt() {
    ProjectorWindow window(projector);
    window.shine();
    QTRY_VERIFY(window.isExposed());
    if (window.surface().keepsStep()) QSKIP("the driver keeps step, where the display has any");
    double refresh = 1e3 / std::max(1.0, window.screen()->refreshRate());
    constexpr int wanted = 10;
    int swaps = -1;  // the first may belong to what came before
    qint64 taken = 0;
    QElapsedTimer elapsed;
    connect(&window, &ProjectorWindow::frameSwapped, &window, [&] {
      if (++swaps == 0) elapsed.start();
      if (swaps == wanted) taken = elapsed.elapsed();
      window.update();
    });
    window.update();
    QTRY_VERIFY(swaps >= wanted);
    QVERIFY2(static_cast<double>(taken) >= wanted * refresh - 1.0, qPrintable(QString::number(taken)));
  }

  void isBlackUntilItIsGivenAPicture() {
    ProjectorWindow window(projector);
    window.shine();
    QTRY_VERIFY(window.isExposed());
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
    window.present(noise({1024, 768}, 4));
    QTRY_VERIFY(!allBlack(seenOn("DUMMY1")));
    window.blacken();
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
  }

  void anotherSizeIsNeverScaled() {
    ProjectorWindow window(projector);
    window.shine();
    QTRY_VERIFY(window.isExposed());
    QImage small = noise({400, 300}, 5);
    window.present(small);
    QTRY_VERIFY(seenOn("DUMMY1").copy(312, 234, 400, 300) == small);
    QImage around = seenOn("DUMMY1");
    for (int y = 234; y < 534; ++y)
      for (int x = 312; x < 712; ++x) around.setPixel(x, y, 0xff000000u);
    QVERIFY(allBlack(around));
    QImage large = noise({1200, 900}, 6);
    window.present(large);
    QTRY_VERIFY(seenOn("DUMMY1") == large.copy(88, 66, 1024, 768));
  }

  void hidesWhenItsDisplayGoesAndComesBackWithIt() {
    ProjectorWindow window(projector);
    QSignalSpy lost(&window, &ProjectorWindow::displayLost), found(&window, &ProjectorWindow::displayFound);
    window.shine();
    QTRY_VERIFY(window.isExposed());
    QImage picture = noise({1024, 768}, 7);
    window.present(picture);
    QTRY_VERIFY(seenOn("DUMMY1") == picture);
    QImage operators = seenOn("DUMMY0");
    for (int cycle = 1; cycle <= unplugCycles(20); ++cycle) {
      unplug();
      QTRY_COMPARE(lost.count(), cycle);
      QVERIFY(!window.isVisible() && !window.isShining());
      QVERIFY(seenOn("DUMMY0") == operators);
      plug();
      QTRY_COMPARE(found.count(), cycle);
      QTRY_VERIFY(seenOn("DUMMY1") == picture);
    }
  }

  /// Law: where light is photographed, a show comes back only after it: whichever was made first, however
  /// often the display goes.
  void comesAfterLightThatIsPhotographed_data() {
    QTest::addColumn<bool>("isLightOlder");
    QTest::newRow("made before") << false;
    QTest::newRow("made after") << true;
  }
  void comesAfterLightThatIsPhotographed() {
    QFETCH(bool, isLightOlder);
    const QImage shown = noise({1024, 768}, 20), measured = noise({1024, 768}, 21);
    auto light = std::make_unique<ProjectorWindow>(projector);
    light->comeFirst();
    ProjectorWindow show(projector);
    if (!isLightOlder) {
      light = std::make_unique<ProjectorWindow>(projector);
      light->comeFirst();
    }
    show.shine();
    show.present(shown);
    QTRY_VERIFY(seenOn("DUMMY1") == shown);
    light->shine();
    light->present(measured);
    QTRY_VERIFY(seenOn("DUMMY1") == measured);
    for (int cycle = 1; cycle <= unplugCycles(3); ++cycle) {
      unplug();
      QTRY_VERIFY(!light->isShining() && !show.isShining());
      plug();
      QTRY_VERIFY(seenOn("DUMMY1") == measured);
      QVERIFY(light->isShining() && !show.isShining());
    }
    // Asked for meanwhile it waits as well.
    show.shine();
    QVERIFY(!show.isShining());
    light->stop();
    QTRY_VERIFY(seenOn("DUMMY1") == shown);
    // A window that is gone keeps nobody waiting.
    light->shine();
    QTRY_VERIFY(seenOn("DUMMY1") == measured);
    unplug();
    plug();
    QTRY_VERIFY(light->isShining());
    QVERIFY(!show.isShining());
    light.reset();
    QTRY_VERIFY(seenOn("DUMMY1") == shown);
  }

  void waitsForADisplayThatIsNotThereYet() {
    unplug();
    ProjectorWindow window(projector);
    window.shine();
    QVERIFY(!window.isVisible() && window.displaySize().isEmpty());
    QImage picture = noise({1024, 768}, 8);
    window.present(picture);
    plug();
    QTRY_VERIFY(seenOn("DUMMY1") == picture);
  }

  void staysHiddenOnceItWasStopped() {
    ProjectorWindow window(projector);
    window.shine();
    QTRY_VERIFY(window.isExposed());
    window.stop();
    unplug();
    plug();
    QVERIFY(!window.isVisible());
  }

  /// A display of another name is somebody else's.
  void anotherDisplayIsLeftAlone() {
    ProjectorWindow window({"DUMMY2", "", "", ""});
    window.shine();
    QVERIFY(!window.isVisible());
    unplug();
    plug();
    QVERIFY(!window.isVisible());
  }

  void passesKeysOn() {
    ProjectorWindow window(projector);
    QSignalSpy keys(&window, &ProjectorWindow::keyPressed);
    window.shine();
    QTRY_VERIFY(window.isExposed());
    QTest::keyClick(&window, Qt::Key_B);
    QCOMPARE(keys.count(), 1);
    QCOMPARE(keys[0][0].toInt(), static_cast<int>(Qt::Key_B));
  }
};

QTEST_MAIN(TestProjectorWindow)
#include "test_projector_window.moc"
