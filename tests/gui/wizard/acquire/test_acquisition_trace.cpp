// SPDX-License-Identifier: MIT
// What is told while the light transport is measured, in order and in words, from the measuring thread.
#include "wizard/acquire/acquisition_trace.h"

#include <QTemporaryDir>
#include <QtTest>
#include <thread>

#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/venue/device_faults.h"
#include "relucent/venue/venue.h"
#include "views/number_text.h"
#include "wizard/acquire/acquire_page.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;
using namespace relucent::linearization;
using namespace relucent::pipeline;
using namespace relucent::rig;
using namespace relucent::sentinels;
using namespace relucent::venue;

namespace {

Reading readingAt(int shot, double roomLight = 0.003) {
  Reading reading;
  reading.shot = shot;
  reading.roomLight = roomLight;
  reading.roomLightAtFirst = reading.roomLightExpected = 0.003;
  return reading;
}

}  // namespace

Q_DECLARE_METATYPE(AlarmKind)
Q_DECLARE_METATYPE(Retake)

class TestAcquisitionTrace : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;

 private slots:
  void readingsArriveInOrderFromAnotherThread() {
    AcquisitionTrace trace;
    trace.begin();
    std::thread measuring([&] {
      for (int shot = 1; shot <= 100; ++shot) trace.checked(readingAt(shot));
    });
    measuring.join();
    QVERIFY(trace.points().empty());  // it speaks on its own thread
    QTRY_COMPARE(trace.points().size(), std::size_t{100});
    double before = 0.0;
    for (std::size_t i = 0; i < trace.points().size(); ++i) {
      QCOMPARE(trace.points()[i].reading.shot, static_cast<int>(i) + 1);
      QVERIFY(trace.points()[i].seconds >= before);
      before = trace.points()[i].seconds;
    }
    QVERIFY(before <= trace.seconds());
  }

  void anAlarmIsCalledByWhatItIs_data() {
    QTest::addColumn<AlarmKind>("kind");
    for (AlarmKind kind : {AlarmKind::flicker, AlarmKind::ambientChanged, AlarmKind::lampChanged,
                           AlarmKind::moved, AlarmKind::localChange, AlarmKind::mirroredScreen,
                           AlarmKind::wrongScreen, AlarmKind::coveredLens, AlarmKind::projectorAsleep})
      QTest::addRow("%d", static_cast<int>(kind)) << kind;
  }
  void anAlarmIsCalledByWhatItIs() {
    QFETCH(AlarmKind, kind);
    const QString heading = AcquisitionTrace::headingOf(kind);
    QVERIFY(!heading.isEmpty() && !heading.endsWith('.'));
  }

  void theRoomLightIsKnownFromTheFirstCheckOn() {
    AcquisitionTrace trace;
    trace.begin();
    QVERIFY(!trace.roomLight());
    trace.checked(readingAt(1, 0.004));
    QCoreApplication::processEvents();
    QCOMPARE(trace.roomLight(), std::optional(RoomLight{0.004, true}));
    Reading changed = readingAt(2, 0.02);
    changed.alarm = AlarmKind::ambientChanged;
    trace.checked(changed);
    QCoreApplication::processEvents();
    QCOMPARE(trace.roomLight(), std::optional(RoomLight{0.02, false}));
  }

  void whatTheMeasurementBeforeSaidIsForgotten() {
    AcquisitionTrace trace;
    trace.begin();
    trace.checked(readingAt(1));
    trace.takenAgain({0, 2, RetakeReason::overexposed});
    QCoreApplication::processEvents();
    QCOMPARE(trace.points().size() + trace.marks().size(), std::size_t{2});
    trace.checked(readingAt(2));  // still on its way
    trace.begin();
    QCoreApplication::processEvents();
    QVERIFY(trace.points().empty() && trace.marks().empty());
    QVERIFY(!trace.states().front().isKnown);
    // Nothing that is on its way belongs to another calibration.
    trace.checked(readingAt(3));
    trace.clear();
    QCoreApplication::processEvents();
    QVERIFY(trace.points().empty());
  }

  void timeStandsStillAtTheEnd() {
    AcquisitionTrace trace;
    QCOMPARE(trace.seconds(), 0.0);
    trace.begin();
    trace.end();
    double end = trace.seconds();
    trace.end();
    QCOMPARE(trace.seconds(), end);
  }

  void anAlarmChangesOneState_data() {
    QTest::addColumn<AlarmKind>("kind");
    QTest::addColumn<int>("state");
    QTest::newRow("room light") << AlarmKind::ambientChanged << 0;
    QTest::newRow("moved") << AlarmKind::moved << 1;
    QTest::newRow("something in the view") << AlarmKind::localChange << 1;
    QTest::newRow("covered lens") << AlarmKind::coveredLens << 1;
    QTest::newRow("lamp") << AlarmKind::lampChanged << 2;
    QTest::newRow("asleep") << AlarmKind::projectorAsleep << 2;
  }
  void anAlarmChangesOneState() {
    QFETCH(AlarmKind, kind);
    QFETCH(int, state);
    AcquisitionTrace trace;
    trace.begin();
    Reading reading = readingAt(40, 0.0065);  // within the limit
    reading.alarm = kind;
    trace.checked(reading);
    QCoreApplication::processEvents();
    auto states = trace.states();
    for (int i = 0; i < 4; ++i) {
      // Through another view nobody sees how bright the lamp is.
      // Through a covered lens nobody sees the room.
      const bool isHidden = kind == AlarmKind::coveredLens && i == 0;
      QCOMPARE(states[static_cast<std::size_t>(i)].isKnown, !isHidden && (state != 1 || i != 2));
      QCOMPARE(states[static_cast<std::size_t>(i)].isSteady, i != state);
    }
    QCOMPARE(trace.roomLight().has_value(), kind != AlarmKind::coveredLens);
    // Of a view that is not seen nothing is measured.
    if (kind == AlarmKind::coveredLens)
      for (std::size_t i = 0; i < 3; ++i)
        QVERIFY2(!states[i].figure.contains('%'), qPrintable(states[i].figure));
    QVERIFY2(kind == AlarmKind::coveredLens || (states[0].figure.contains(decimalText(0.65, 2)) &&
                                                states[0].figure.contains(decimalText(0.35, 2))),
             qPrintable(states[0].figure));
    // Taken again, what was put right is no warning any more; whether it is good says the next check.
    QVERIFY(!trace.takesAgainFor());
    trace.takenAgain({20, 21, RetakeReason::alarm, kind});
    QCoreApplication::processEvents();
    QCOMPARE(trace.takesAgainFor(), kind);
    states = trace.states();
    for (int i = 0; i < 4; ++i) {
      QVERIFY(states[static_cast<std::size_t>(i)].isSteady);
      const bool isHidden = kind == AlarmKind::coveredLens && i == 0;
      QCOMPARE(states[static_cast<std::size_t>(i)].isKnown,
               !isHidden && i != state && (state != 1 || i != 2));
      QVERIFY(!states[static_cast<std::size_t>(i)].figure.contains("sees nothing"));
    }
    // Tried again, it is well.
    trace.checked(readingAt(40));
    QCoreApplication::processEvents();
    for (const WatchState& watch : trace.states()) QVERIFY(watch.isSteady && watch.isKnown);
    QVERIFY(!trace.takesAgainFor());
  }

  void whatIsAskedBetweenTwoChecksIsNotSteady_data() {
    QTest::addColumn<AlarmKind>("kind");
    QTest::addColumn<std::size_t>("state");
    QTest::newRow("room light") << AlarmKind::ambientChanged << std::size_t{0};
    QTest::newRow("moved") << AlarmKind::moved << std::size_t{1};
    QTest::newRow("covered lens") << AlarmKind::coveredLens << std::size_t{1};
    QTest::newRow("flicker") << AlarmKind::flicker << std::size_t{3};
    QTest::newRow("flicker, or moved") << AlarmKind::unsteady << std::size_t{3};
  }
  /// Law: what somebody is asked about is called steady nowhere, whether or not a check found it; its figure
  /// is not that of the check before. Answered, it is taken again for that.
  void whatIsAskedBetweenTwoChecksIsNotSteady() {
    QFETCH(AlarmKind, kind);
    QFETCH(std::size_t, state);
    AcquisitionTrace trace;
    trace.begin();
    trace.checked(readingAt(40));
    QCoreApplication::processEvents();
    QVERIFY(trace.states()[state].isSteady);
    trace.setAsked(kind);
    QVERIFY(!trace.states()[state].isSteady);
    QCOMPARE(trace.states()[state].figure, AcquisitionTrace::tr("Found since the last check."));
    QCOMPARE(trace.roomLight()->isSteady, state != 0);
    trace.takenAgain({20, 21, RetakeReason::alarm, kind});
    trace.setAsked(std::nullopt);
    QCoreApplication::processEvents();
    QCOMPARE(trace.takesAgainFor(), kind);
    QVERIFY(trace.states()[state].isSteady && trace.roomLight()->isSteady);
  }

  /// Law: once all is measured from the start, nothing is compared with the light of before.
  void aNewStartForgetsTheReadings() {
    AcquisitionTrace trace;
    trace.begin();
    trace.checked(readingAt(2, 0.05));
    trace.takenAgain({20, 21, RetakeReason::alarm, AlarmKind::moved});
    QCoreApplication::processEvents();
    QCOMPARE(trace.points().size(), std::size_t{1});
    QVERIFY(!trace.takesAllAgain());
    trace.grew({32, 11}, 7);
    trace.takenAgain({0, 41, RetakeReason::alarm, AlarmKind::ambientChanged});
    QCoreApplication::processEvents();
    QVERIFY(trace.points().empty() && !trace.roomLight() && !trace.states()[0].isKnown);
    QCOMPARE(trace.marks().size(), std::size_t{2});
    QCOMPARE(trace.takesAgainFor(), AlarmKind::ambientChanged);
    // Nor is any level through.
    QVERIFY(trace.takesAllAgain() && trace.growth().levels.empty());
  }

  void flickerBeyondItsLimitIsAState() {
    AcquisitionTrace trace;
    trace.begin();
    Reading reading = readingAt(40);
    reading.flicker = 1.01 * reading_limit::flicker;
    trace.checked(reading);
    QCoreApplication::processEvents();
    QVERIFY(trace.states()[0].isSteady && !trace.states()[3].isSteady);
  }

  /// Law: there is one alarm at a time, and no light beyond its limit is called steady beside it.
  void otherLightIsNotSteady() {
    for (double off : {0.9, 1.1}) {
      AcquisitionTrace trace;
      trace.begin();
      Reading reading = readingAt(40);
      reading.alarm = AlarmKind::projectorAsleep;
      reading.roomLight = reading.roomLightExpected + off * reading_limit::roomLight;
      trace.checked(reading);
      QCoreApplication::processEvents();
      QCOMPARE(trace.states()[0].isSteady, off < 1.0);
      QCOMPARE(trace.roomLight()->isSteady, off < 1.0);
    }
  }

  /// Law: a camera that is put right makes no light right.
  void whatWasPutRightIsTheView() {
    AcquisitionTrace trace;
    trace.begin();
    Reading reading = readingAt(40);
    reading.alarm = AlarmKind::moved;
    reading.view = 2.0 * reading_limit::view;
    reading.roomLight = reading.roomLightExpected + 2.0 * reading_limit::roomLight;
    trace.checked(reading);
    QCoreApplication::processEvents();
    QVERIFY(!trace.states()[0].isSteady && !trace.states()[1].isSteady);
    trace.setPutRight(true);
    QVERIFY(!trace.states()[0].isSteady && trace.states()[1].isSteady);
    trace.takenAgain({20, 21, RetakeReason::alarm, AlarmKind::moved});
    QCoreApplication::processEvents();
    QVERIFY(trace.states()[0].isSteady && !trace.states()[0].isKnown);
  }

  void anotherViewIsNotStill() {
    for (double off : {0.9, 1.1}) {
      AcquisitionTrace trace;
      trace.begin();
      Reading reading = readingAt(40);
      reading.alarm = AlarmKind::ambientChanged;
      reading.view = off * reading_limit::view;
      trace.checked(reading);
      QCoreApplication::processEvents();
      QCOMPARE(trace.states()[1].isSteady, off < 1.0);
    }
  }

  void whatIsTakenAgainIsListedNewestFirst() {
    AcquisitionTrace trace;
    trace.begin();
    trace.takenAgain({90, 2, RetakeReason::alarm, AlarmKind::ambientChanged});
    trace.takenAgain({213, 1, RetakeReason::overexposed});
    trace.takenAgain({240, 12, RetakeReason::contradiction});
    QCoreApplication::processEvents();
    std::vector<TakenAgain> lines = trace.takenAgain(2);
    QCOMPARE(lines.size(), std::size_t{2});
    QCOMPARE(lines[0].patterns, AcquisitionTrace::tr("No. %1 to %2").arg(241).arg(252));
    QCOMPARE(lines[1].patterns, AcquisitionTrace::tr("No. %1").arg(214));
    lines = trace.takenAgain(10);
    QCOMPARE(lines.size(), std::size_t{3});
    QCOMPARE(lines[2].reason, AcquisitionTrace::tr("the room light changed"));
    QVERIFY(lines[0].reason != lines[1].reason && !lines[0].reason.isEmpty());
  }

  /// The lens is pushed and the operator accepts it: the page says so beside the result.
  void whatWasAcceptedIsOnThePage() {
    CalibrateSettings settings;
    VenueSettings venue;
    venue.name = "corner";
    venue.projector = venue.camera = {48, 36};
    venue.pathsPerPixel = 16;
    settings.rig = venue;
    settings.linearization.levels = 9;
    settings.acquisition.checkInterval = 40;
    Session session{std::filesystem::path(folder_.filePath("cache").toStdString())};
    session.begin(folder_.filePath("pushed").toStdString(), settings);
    AcquirePage page(session);
    QVERIFY(page.findings().isEmpty());

    Progress progress;
    SimulatedVenue simulated(venue, {}, progress);
    DeviceFault push;
    push.kind = FaultKind::shiftedCamera;
    push.stage = nameOf(Stage::acquisition);
    push.first = 60;
    push.last = 100000;
    push.amount = 2.0;
    auto faults = std::make_shared<FaultSchedule>();
    faults->faults = {push};
    Rig rig = simulated.rig(faults);
    {
      CalibrationFolder folder = CalibrationFolder::open(session.path(), CalibrationFolder::Access::write);
      Linearization linearization = measureLinearization(folder, rig, progress);
      AcquisitionObserver nobody;
      measureAcquisition(
          folder, rig, linearization, [](const Alarm&) { return Answer::skip; }, nobody, progress);
    }
    session.reload();
    QCOMPARE(page.findings().filter("Accepted before pattern").size(), 1);
  }

  /// A rehearsal, measured through the page: nothing happens, and the trace says so.
  void aMeasurementIsTraced() {
    Session session{std::filesystem::path(folder_.filePath("cache").toStdString())};
    AcquirePage page(session);
    connect(&page, &PageModel::failed, this, [](const FailureReport& report) {
      qWarning("%s %s", qPrintable(report.failure.what), qPrintable(report.failure.advice));
    });
    CalibrateSettings settings;
    VenueSettings venue;
    venue.name = "plain";
    venue.projector = venue.camera = {48, 36};
    venue.pathsPerPixel = 16;
    settings.rig = venue;
    settings.linearization.levels = 9;
    settings.acquisition.checkInterval = 15;
    session.begin(folder_.filePath("traced").toStdString(), settings);
    QVERIFY(page.trace().points().empty());
    page.primary()->trigger();
    QVERIFY(page.isMeasuring());
    QTRY_VERIFY_WITH_TIMEOUT(!page.isMeasuring(), 120000);
    QVERIFY(session.progress(Stage::acquisition) == StageProgress::done);
    const auto& points = page.trace().points();
    QVERIFY2(points.size() > 5, qPrintable(QString::number(points.size())));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Reading& reading = points[i].reading;
      QVERIFY(!reading.alarm &&
              std::abs(reading.roomLight - reading.roomLightExpected) < reading_limit::roomLight);
      if (i > 0) QVERIFY(reading.shot > points[i - 1].reading.shot);
    }
    for (const WatchState& state : page.trace().states()) QVERIFY(state.isKnown && state.isSteady);
    session.open(session.path());
    QVERIFY(page.trace().points().empty());
  }
};

QTEST_MAIN(TestAcquisitionTrace)
#include "test_acquisition_trace.moc"
