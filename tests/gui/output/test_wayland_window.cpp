// SPDX-License-Identifier: MIT
// Runs under a Wayland compositor with two outputs, see tests/support/with-two-outputs.
#include <QSignalSpy>
#include <QtTest>

#include "gui/output/two_outputs.h"
#include "gui/output/two_screens.h"
#include "output/projector_window.h"
#include "output/window_projector.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

const ScreenIdentity projectorsOutput{"HEADLESS-2", "headless", "headless", ""};

void setOutput(QSize mode, double scale) {
  sway({"output", "HEADLESS-2", "mode", QString("%1x%2").arg(mode.width()).arg(mode.height()), "scale",
        QString::number(scale)});
  const QSizeF logical = QSizeF(mode) / scale;
  QTRY_VERIFY(outputOf("HEADLESS-2") != nullptr && nativeSize(*outputOf("HEADLESS-2")) == mode);
  QTRY_VERIFY(std::abs(outputOf("HEADLESS-2")->geometry().width() - logical.width()) < 1.0 &&
              std::abs(outputOf("HEADLESS-2")->geometry().height() - logical.height()) < 1.0 &&
              outputOf("HEADLESS-2")->devicePixelRatio() >= scale);
}

/// The share of pixels that are the same.
double alike(const QImage& shown, const QImage& wanted) {
  if (shown.size() != wanted.size()) return 0.0;
  qint64 same = 0;
  for (int y = 0; y < wanted.height(); ++y)
    for (int x = 0; x < wanted.width(); ++x) same += shown.pixel(x, y) == wanted.pixel(x, y);
  return static_cast<double>(same) / (double{1} * wanted.width() * wanted.height());
}

bool isLit(const QImage& shown) {
  for (int y = 0; y < shown.height(); ++y)
    for (int x = 0; x < shown.width(); ++x)
      if (shown.pixel(x, y) == 0xffffffffu) return true;
  return false;
}

}  // namespace

/// On Wayland, and through XWayland, where the desktop has the last word on where a window stands: see
/// CMakeLists.txt.
class TestWaylandWindow : public QObject {
  Q_OBJECT

  static bool isWayland() { return QGuiApplication::platformName().startsWith("wayland"); }

 private slots:
  void everyPixelArrivesOnItsOutputAloneAtEveryScale_data() {
    QTest::addColumn<QSize>("mode");
    QTest::addColumn<double>("scale");
    QTest::addColumn<double>("share");
    // The compositor's own renderer, in memory, samples to 16 binary digits: where the desktop's units do not
    // divide the output, it takes a neighbour of some pixels in a thousand.
    constexpr double all = 1.0, nearlyAll = 0.995;
    for (double scale : {1.0, 1.25, 1.5, 2.0})
      QTest::addRow("1920x1080 at %g", scale) << QSize(1920, 1080) << scale << all;
    for (double scale : {1.0, 1.6, 2.0})
      QTest::addRow("1024x768 at %g", scale) << QSize(1024, 768) << scale << all;
    QTest::addRow("320x240 at 1.25") << QSize(320, 240) << 1.25 << all;
    for (double scale : {1.25, 1.5, 1.75})
      QTest::addRow("1024x768 at %g", scale) << QSize(1024, 768) << scale << nearlyAll;
    for (double scale : {1.5, 1.75})
      QTest::addRow("1279x719 at %g", scale) << QSize(1279, 719) << scale << nearlyAll;
  }
  void everyPixelArrivesOnItsOutputAloneAtEveryScale() {
    if (!isWayland()) QSKIP("of Wayland");
    QFETCH(QSize, mode);
    QFETCH(double, scale);
    QFETCH(double, share);
    setOutput(mode, scale);
    QCOMPARE(unusableReason(*outputOf("HEADLESS-2")), QString());
    const QImage operators = shownOn("HEADLESS-1");
    ProjectorWindow window(projectorsOutput);
    QCOMPARE(window.displaySize(), mode);
    window.shine();
    for (quint32 seed : {1u, 2u}) {
      const QImage picture = noise(mode, seed);
      window.present(picture);
      QTRY_VERIFY(alike(shownOn("HEADLESS-2"), picture) >= share);
    }
    QVERIFY(shownOn("HEADLESS-1") == operators);
  }

  /// Qt draws by whole numbers: less than the output has, where two do not divide it.
  void anOutputThatCannotBeFilledIsRefused() {
    if (!isWayland()) QSKIP("of Wayland");
    setOutput({1279, 719}, 2.0);
    QVERIFY(unusableReason(*outputOf("HEADLESS-2")).contains("scales this screen by 2"));
  }

  void hidesWhenItsOutputGoesAndComesBackWithIt() {
    if (!isWayland()) QSKIP("of Wayland");
    setOutput({1024, 768}, 1.6);
    ProjectorWindow window(projectorsOutput);
    QSignalSpy lost(&window, &ProjectorWindow::displayLost), found(&window, &ProjectorWindow::displayFound);
    window.shine();
    const QImage picture = noise({1024, 768}, 7), operators = shownOn("HEADLESS-1");
    window.present(picture);
    QTRY_VERIFY(shownOn("HEADLESS-2") == picture);
    for (int cycle = 1; cycle <= unplugCycles(5); ++cycle) {
      if (!unplugOutput()) QSKIP("this compositor's outputs cannot be unplugged");
      QTRY_COMPARE(lost.count(), cycle);
      QVERIFY(!window.isVisible() && !window.isShining() && window.elsewhere().isEmpty());
      QTRY_VERIFY(shownOn("HEADLESS-1") == operators);
      plugOutput();
      QTRY_COMPARE(found.count(), cycle);
      QTRY_VERIFY(shownOn("HEADLESS-2") == picture);
    }
  }

  void leavesAtOnceWhenItIsMovedElsewhere() {
    if (!isWayland()) QSKIP("of Wayland");
    setOutput({1024, 768}, 1.0);
    ProjectorWindow window(projectorsOutput);
    QSignalSpy lost(&window, &ProjectorWindow::displayLost), found(&window, &ProjectorWindow::displayFound);
    window.shine();
    const QImage picture = noise({1024, 768}, 8), operators = shownOn("HEADLESS-1");
    window.present(picture);
    QTRY_VERIFY(shownOn("HEADLESS-2") == picture);
    sway({"[title=\"HEADLESS-2\"]", "move", "container", "to", "output", "HEADLESS-1"});
    QTRY_COMPARE(lost.count(), 1);
    QCOMPARE(window.elsewhere(), QString("HEADLESS-1"));
    QTRY_VERIFY(shownOn("HEADLESS-1") == operators);
    // And tries again by itself.
    QTRY_COMPARE_WITH_TIMEOUT(found.count(), 1, 10'000);
    QTRY_VERIFY(shownOn("HEADLESS-2") == picture);
  }

  /// XWayland's windows go where the compositor likes: the operator's output, for this one.
  void isNeverSeenOnTheOperatorsOutputThroughXWayland() {
    if (isWayland()) QSKIP("of XWayland");
    ProjectorWindow window({"XWAYLAND1", "", "", ""});
    QSignalSpy lost(&window, &ProjectorWindow::displayLost), swapped(&window, &ProjectorWindow::frameSwapped);
    QImage white(window.displaySize(), QImage::Format_RGB32);
    white.fill(Qt::white);
    window.present(white);
    window.shine();
    int lit = 0;
    QTRY_VERIFY((lit += isLit(shownOn("HEADLESS-1")), !lost.empty() || !swapped.empty()));
    QCOMPARE(lit, 0);
    if (lost.empty())
      QTRY_VERIFY(shownOn("HEADLESS-2") == white);
    else
      QVERIFY(swapped.empty() && !window.isVisible() && !window.elsewhere().isEmpty());
  }
};

QTEST_MAIN(TestWaylandWindow)
#include "test_wayland_window.moc"
