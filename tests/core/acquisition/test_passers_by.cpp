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
    QCOMPARE(static_cast<int>(again.size()), fault.last - fault.first + 1);
    QVERIFY2(others <= 2, qPrintable(QString::number(others)));
    QVERIFY(flaggedIn(a) <= flaggedIn(sound) + 2);
    QVERIFY(a.verificationError < 1.1 * sound.verificationError);
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
