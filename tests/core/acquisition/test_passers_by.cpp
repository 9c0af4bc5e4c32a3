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
    DeviceFault flash = handOver(90);
    flash.kind = FaultKind::flash;
    flash.amount = 20.0;
    flash.last = 90;
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

  /// T follows from photographs that a check has confirmed: the later ones, in the dark, would spoil it.
  void whatIsKeptAfterAnAlarmHasBeenConfirmed() {
    venue_.faults->faults = {fault(FaultKind::coveredLens, 70)};
    const Acquisition& sound = venue_.sound();
    NoShotLog log;
    Acquisition a = venue_.run([](const Alarm&) { return Answer::keepAndStop; }, log);
    QVERIFY(a.stoppedAt > 0 && a.patterns < sound.patterns);
    ProjectorStack pattern(naturalPattern(sound.transport.projectors()));
    double error = relativeError(a.transport.apply(pattern), sound.transport.apply(pattern));
    qInfo("%d patterns, natural picture off by %.4f", a.patterns, error);
    // 0.08; with the photographs in the dark 0.12. What is left is of coarser blocks, and of what rows learnt
    // from the dark before the check found it.
    QVERIFY(error < 0.1);
  }

 private:
  FaultyVenue venue_{AcquisitionMode::multiplexed};
};

QTEST_APPLESS_MAIN(TestPassersBy)
#include "test_passers_by.moc"
