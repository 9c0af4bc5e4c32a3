// SPDX-License-Identifier: MIT
// What a frame takes on this machine.
#include "relucent/engine/frame_cost.h"

#include <QtTest>

#include "core/engine/engine_scenes.h"

using namespace relucent;
using namespace relucent::engine;
using namespace relucent::synthetic;

class TestFrameCost : public QObject {
  Q_OBJECT

 private slots:
  /// Law: it is this machine's time: more content takes longer, and no frame takes none.
  void largerContentTakesLonger() {
    const compensation::MeasuredVenue venue = venueOf(makeScene({}));
    Progress quiet;
    const FrameCost small = measureFrameCost(venue, {64, 48}, quiet, BackendChoice::cpu);
    const FrameCost large = measureFrameCost(venue, {3840, 2160}, quiet, BackendChoice::cpu);
    QVERIFY(small.seconds > 0.0 && small.stepSeconds >= 0.0);
    QVERIFY(small.seconds < 1.0);
    QVERIFY(large.seconds > small.seconds);
    QVERIFY2(QString::fromStdString(small.device).startsWith("CPU"), small.device.c_str());
  }

  void whoeverWaitsMayEndIt() {
    StopRequest stop;
    stop.ask(StopRequest::Kind::cancel);
    struct Nobody : ProgressSink {
      void progressed(double, const Message&) override {}
    } nobody;
    Progress progress(nobody, stop);
    const compensation::MeasuredVenue venue = venueOf(makeScene({}));
    QVERIFY_EXCEPTION_THROWN(measureFrameCost(venue, {64, 48}, progress, BackendChoice::cpu), Cancelled);
  }
};

QTEST_APPLESS_MAIN(TestFrameCost)
#include "test_frame_cost.moc"
