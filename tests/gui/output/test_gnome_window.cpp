// SPDX-License-Identifier: MIT
// Runs under GNOME's compositor with two monitors, see tests/support/with-two-monitors.
#include <QDeadlineTimer>
#include <QtTest>

#include "desktop/cast_frames.h"
#include "gui/output/two_screens.h"
#include "output/projector_window.h"
#include "output/window_projector.h"
#include "support/gnome_monitors.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

const char* const operators = "Meta-0";
const char* const projectors = "Meta-1";

/// What a monitor shows now, in its own pixels.
QImage shownOn(const char* connector) {
  tests::GnomeMonitors monitors;
  const tests::GnomeMonitors::Recording recording = monitors.record(connector);
  CastFrames frames(tests::connectedToPipeWire(), recording.node());
  QImage shown;
  for (QDeadlineTimer late(10'000); shown.isNull() && !late.hasExpired();)
    shown = frames.next(std::chrono::milliseconds(100));
  return shown.convertToFormat(QImage::Format_RGB32);
}

}  // namespace

class TestGnomeWindow : public QObject {
  Q_OBJECT

  static void setScale(double scale) {
    QCOMPARE(tests::GnomeMonitors().scale(projectors, scale), scale);
    QTRY_VERIFY(screenOn(projectors) != nullptr &&
                std::abs(screenOn(projectors)->geometry().width() - 1920 / scale) < 1.0 &&
                screenOn(projectors)->devicePixelRatio() >= scale);
  }

 private slots:
  void everyPixelArrivesOnItsMonitorAloneAtEveryScale_data() {
    QTest::addColumn<double>("scale");
    for (const double scale : {1.0, 1.25, 1.5, 2.0}) QTest::addRow("%g", scale) << scale;
  }
  void everyPixelArrivesOnItsMonitorAloneAtEveryScale() {
    QFETCH(double, scale);
    setScale(scale);
    QCOMPARE(unusableReason(*screenOn(projectors)), QString());
    const QImage before = shownOn(operators);
    ProjectorWindow window(identityOf(*screenOn(projectors)));
    QCOMPARE(window.displaySize(), QSize(1920, 1080));
    window.shine();
    for (const quint32 seed : {1u, 2u}) {
      const QImage picture = noise({1920, 1080}, seed);
      window.present(picture);
      QTRY_VERIFY(shownOn(projectors) == picture);
    }
    QVERIFY(shownOn(operators) == before);
  }
};

QTEST_MAIN(TestGnomeWindow)
#include "test_gnome_window.moc"
