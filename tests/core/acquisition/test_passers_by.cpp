// SPDX-License-Identifier: MIT
#include <QtTest>
#include <set>

#include "faulty_venue.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::rig;
using namespace relucent::sentinels;
using namespace relucent::transport;
using namespace relucent::venue;
using namespace relucent::test;

class TestPassersBy : public QObject {
  Q_OBJECT

 private slots:
  void whatPassedByIsMeasuredAgain_data() {
    QTest::addColumn<DeviceFault>("fault");
    DeviceFault hand = handOver(20);
    hand.last = 20;
    QTest::newRow("hand, one photograph") << hand;
    hand.first = 60;
    hand.last = 63;
    QTest::newRow("hand, four photographs") << hand;
    hand.first = 20;
    hand.last = 31;
    QTest::newRow("hand, twelve photographs of the first level") << hand;
    hand.first = 60;
    hand.last = 75;
    QTest::newRow("hand, sixteen photographs") << hand;
    DeviceFault flash = handOver(75);
    flash.kind = FaultKind::flash;
    flash.amount = 20.0;
    flash.last = 75;
    QTest::newRow("flash") << flash;
  }
  /// Nobody is asked: a check sees no hand that has gone.
  void whatPassedByIsMeasuredAgain() {
    QFETCH(DeviceFault, fault);
    venue_.faults->faults = {fault};
    const Acquisition& sound = venue_.sound();
    NoShotLog log;
    Listening observer;
    Acquisition a = venue_.run([](const Alarm&) { return Answer::skip; }, log, observer);
    qInfo("%d patterns for %d, verification %.4f for %.4f, %zu flagged for %zu", a.patterns, sound.patterns,
          a.verificationError, sound.verificationError, flaggedIn(a), flaggedIn(sound));
    int others = 0;
    std::set<int> again;
    for (const Retake& retake : observer.retakes) {
      QCOMPARE(retake.reason, RetakeReason::contradiction);
      if (retake.shot >= fault.first && retake.shot <= fault.last)
        again.insert(retake.shot);
      else
        ++others;
    }
    const int spoilt = fault.last - fault.first + 1;
    QCOMPARE(static_cast<int>(again.size()), spoilt);
    // Beside many that were spoilt sound ones contradict, too.
    QVERIFY2(others <= std::max(2, spoilt / 2), qPrintable(QString::number(others)));
    QVERIFY(flaggedIn(a) <= flaggedIn(sound) + 2);
    QVERIFY(a.verificationError < 1.1 * sound.verificationError);
  }

  void aDarkPhotographIsLookedIntoAtOnce_data() {
    QTest::addColumn<int>("first");
    QTest::addColumn<int>("last");
    QTest::addColumn<FaultKind>("kind");
    const auto row = [](const char* name, int first, int last, FaultKind kind = FaultKind::coveredLens) {
      QTest::newRow(name) << first << last << kind;
    };
    row("covered for one photograph of the first level", 20, 20);
    row("covered for twelve photographs of the first level", 20, 31);
    row("covered for one photograph of fine blocks", 70, 70);
    row("covered for thirty photographs", 60, 89);
    row("covered for one test pattern", -1, -1);
    row("no picture for one photograph", 45, 45, FaultKind::asleepProjector);
    row("no picture for ten photographs", 45, 54, FaultKind::asleepProjector);
  }
  /// Law: what was dark for a moment leaves no trace; whoever measures is asked only if it lasts until the
  /// look that follows.
  void aDarkPhotographIsLookedIntoAtOnce() {
    QFETCH(int, first);
    QFETCH(int, last);
    QFETCH(FaultKind, kind);
    const Acquisition& sound = venue_.sound();
    if (first < 0) first = last = sound.patterns - 4;  // before the last look's two
    DeviceFault dark = fault(kind, first);
    dark.last = last;
    venue_.faults->faults = {dark};
    std::vector<AlarmKind> asked;
    NoShotLog log;
    Listening observer;
    const Acquisition a = venue_.run(
        [&](const Alarm& alarm) {
          asked.push_back(alarm.kind);
          venue_.faults->faults.clear();
          return Answer::retry;
        },
        log, observer);
    const bool lasts = last > first;
    QCOMPARE(asked.size(), lasts ? std::size_t{1} : std::size_t{0});
    if (lasts)
      QCOMPARE(asked.front(),
               kind == FaultKind::coveredLens ? AlarmKind::coveredLens : AlarmKind::projectorAsleep);
    std::vector<Retake> again;
    std::ranges::copy_if(observer.retakes, std::back_inserter(again),
                         [](const Retake& retake) { return retake.reason == RetakeReason::dark; });
    QCOMPARE(again.size(), lasts ? std::size_t{0} : std::size_t{1});
    if (!lasts) QCOMPARE(again.front().shot, first);
    qInfo("verification %.4f for %.4f, %zu flagged for %zu", a.verificationError, sound.verificationError,
          flaggedIn(a), flaggedIn(sound));
    QVERIFY(flaggedIn(a) <= flaggedIn(sound) + 2);
    QVERIFY(a.verificationError < 1.1 * sound.verificationError);
    if (lasts) QVERIFY(a.transport == sound.transport);
  }

  /// T follows from photographs that a check has confirmed: what disturbed the later ones leaves no trace.
  void whatIsKeptAfterAnAlarmHasBeenConfirmed_data() {
    QTest::addColumn<int>("shot");
    for (int shot : {30, 45, 60}) QTest::addRow("from shot %d", shot) << shot;
  }
  void whatIsKeptAfterAnAlarmHasBeenConfirmed() {
    QFETCH(int, shot);
    const Acquisition covered = keptAfter(fault(FaultKind::coveredLens, shot));
    const Acquisition asleep = keptAfter(fault(FaultKind::asleepProjector, shot));
    QVERIFY(covered.stoppedAt > 0 && covered.patterns < venue_.sound().patterns);
    QVERIFY(covered.transport == asleep.transport);
    ProjectorStack pattern(naturalPattern(covered.transport.projectors()));
    qInfo("%d patterns, natural picture off by %.4f", covered.patterns,
          relativeError(covered.transport.apply(pattern), venue_.sound().transport.apply(pattern)));
  }

  void aChangeWhileItIsToEnd_data() {
    QTest::addColumn<DeviceFault>("fault");
    QTest::addColumn<int>("asked");  // before which photograph to stop and keep; below nothing: the last
    QTest::newRow("bumped amid the patterns") << fault(FaultKind::shiftedCamera, 45, 2.0) << 46;
    QTest::newRow("room light amid the patterns") << fault(FaultKind::ambient, 45, 0.05) << 46;
    QTest::newRow("bumped at the end") << fault(FaultKind::shiftedCamera, -1, 2.0) << -1;
  }
  /// Law: whoever has asked to stop and keep is asked about no alarm. What no look has confirmed is left out,
  /// the change is said, and put right it goes on as if nothing had happened.
  void aChangeWhileItIsToEnd() {
    QFETCH(DeviceFault, fault);
    QFETCH(int, asked);
    const Acquisition& sound = venue_.sound();
    QVERIFY(!sound.changed);
    // Of the test patterns, which two photographs of a look follow.
    const int last = sound.patterns - 3;
    if (fault.first < 0) fault.first = last;
    if (asked < 0) asked = last;
    venue_.faults->faults = {fault};
    struct Sink : ProgressSink {
      void progressed(double, const Message&) override {}
    } sink;
    StopRequest stop;
    venue_.before = [&](const CaptureRequest& request) {
      if (request.shot.number >= asked) stop.ask(StopRequest::Kind::keep);
    };
    int questions = 0;
    MemoryLog log;
    AcquisitionObserver nobody;
    const Acquisition kept = venue_.run(
        [&](const Alarm&) {
          ++questions;
          return Answer::retry;
        },
        log, nobody, Progress(sink, stop));
    venue_.before = {};
    venue_.faults->faults.clear();
    QCOMPARE(questions, 0);
    QVERIFY(kept.changed.has_value());
    QCOMPARE(kept.changed->moved, fault.kind == FaultKind::shiftedCamera);
    const auto isSaid = [&](const Message& finding) {
      return english(finding).find(english(kept.changed->what)) != std::string::npos;
    };
    QCOMPARE(std::ranges::count_if(kept.findings, isSaid), 1);
    QCOMPARE(kept.stoppedAt > 0, asked != last);
    QVERIFY(flaggedIn(kept) <= flaggedIn(sound));
    if (asked == last) QVERIFY(kept.transport == sound.transport);
    for (const auto& [number, shot] : log.shots) QVERIFY(number < fault.first);
    const Acquisition whole = venue_.run({}, log);
    QVERIFY(whole.transport == sound.transport && whole.flagged == sound.flagged);
    QVERIFY(!whole.changed && whole.stoppedAt == 0);
  }

 private:
  Acquisition keptAfter(const DeviceFault& fault) {
    venue_.faults->faults = {fault};
    NoShotLog log;
    return venue_.run([](const Alarm&) { return Answer::keepAndStop; }, log);
  }

  FaultyVenue venue_{AcquisitionMode::multiplexed};
};

QTEST_APPLESS_MAIN(TestPassersBy)
#include "test_passers_by.moc"
