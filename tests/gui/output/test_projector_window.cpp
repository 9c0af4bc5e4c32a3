// SPDX-License-Identifier: MIT
// Runs on two screens that can be unplugged, see tests/support/with-two-screens.
#include <QProcess>
#include <QRandomGenerator>
#include <QSignalSpy>
#include <QtTest>

#include "output/projector_window.h"

using namespace relucent;

namespace {

QScreen* screenOn(const QString& connector) {
  for (QScreen* screen : QGuiApplication::screens())
    if (screen->name() == connector) return screen;
  return nullptr;
}

void xrandr(const QStringList& arguments) {
  QCOMPARE(QProcess::execute("xrandr", arguments), 0);
}
void unplug() {
  xrandr({"--output", "DUMMY1", "--off"});
  QTRY_VERIFY(screenOn("DUMMY1") == nullptr);
}
void plug() {
  xrandr({"--output", "DUMMY1", "--mode", "1024x768", "--right-of", "DUMMY0"});
  QTRY_VERIFY(screenOn("DUMMY1") != nullptr);
}

QImage noise(QSize size, quint32 seed) {
  QImage image(size, QImage::Format_RGB32);
  QRandomGenerator random(seed);
  for (int y = 0; y < size.height(); ++y)
    for (int x = 0; x < size.width(); ++x) image.setPixel(x, y, random.generate() | 0xff000000u);
  return image;
}

/// What stands on a screen now.
QImage seenOn(const QString& connector) {
  QScreen* screen = screenOn(connector);
  if (screen == nullptr) return {};
  return screen->grabWindow(0).toImage().convertToFormat(QImage::Format_RGB32);
}

bool allBlack(const QImage& image) {
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if ((image.pixel(x, y) & 0xffffffu) != 0) return false;
  return !image.isNull();
}

const ScreenIdentity projector{"DUMMY1", "", "", ""};

}  // namespace

class TestProjectorWindow : public QObject {
  Q_OBJECT

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
    for (int cycle = 1; cycle <= 20; ++cycle) {
      unplug();
      QTRY_COMPARE(lost.count(), cycle);
      QVERIFY(!window.isVisible() && !window.isShining());
      QVERIFY(seenOn("DUMMY0") == operators);
      plug();
      QTRY_COMPARE(found.count(), cycle);
      QTRY_VERIFY(seenOn("DUMMY1") == picture);
    }
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
