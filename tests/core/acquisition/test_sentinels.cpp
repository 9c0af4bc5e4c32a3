// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>
#include <numeric>

#include "faulty_venue.h"
#include "relucent/base/error.h"
#include "relucent/sentinels/observer.h"
#include "relucent/venue/device_faults.h"
#include "relucent/venue/venue.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::linearization;
using namespace relucent::rig;
using namespace relucent::sentinels;
using namespace relucent::transport;
using namespace relucent::venue;
using namespace relucent::test;

Q_DECLARE_METATYPE(AlarmKind)

class TestSentinels : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    venue_ = std::make_unique<FaultyVenue>(AcquisitionMode::adaptive);
    // Shot 12 on is after the floods of 3 rounds, shot 60 amid the tree.
    QVERIFY2(venue_->sound().patterns > 100, qPrintable(QString::number(venue_->sound().patterns)));
    qInfo("%d patterns, %d exposures, verification %.4f", venue_->sound().patterns, venue_->sound().exposures,
          venue_->sound().verificationError);
  }

  void faults_data() {
    QTest::addColumn<DeviceFault>("fault");
    QTest::addColumn<AlarmKind>("kind");
    QTest::newRow("flicker") << fault(FaultKind::flicker, 60, 0.1) << AlarmKind::flicker;
    QTest::newRow("ambient") << fault(FaultKind::ambient, 60, 0.05) << AlarmKind::ambientChanged;
    QTest::newRow("shifted camera") << fault(FaultKind::shiftedCamera, 60, 2.0) << AlarmKind::moved;
    QTest::newRow("shifted camera among the floods")
        << fault(FaultKind::shiftedCamera, 6, 2.0) << AlarmKind::moved;
    QTest::newRow("shifted camera after the floods")
        << fault(FaultKind::shiftedCamera, 12, 2.0) << AlarmKind::moved;
    QTest::newRow("shifted camera amid the first look")
        << fault(FaultKind::shiftedCamera, 14, 2.0) << AlarmKind::moved;
    QTest::newRow("turned camera after the floods")
        << fault(FaultKind::shiftedCamera, 12, 0.0, 4.0) << AlarmKind::moved;
    QTest::newRow("turned camera") << fault(FaultKind::shiftedCamera, 60, 0.0, 4.0) << AlarmKind::moved;
    QTest::newRow("mirrored screen") << fault(FaultKind::mirroredScreen, 0) << AlarmKind::mirroredScreen;
    QTest::newRow("covered lens") << fault(FaultKind::coveredLens, 60) << AlarmKind::coveredLens;
    QTest::newRow("sleeping projector")
        << fault(FaultKind::asleepProjector, 60) << AlarmKind::projectorAsleep;
    QTest::newRow("something in the view") << handOver(60) << AlarmKind::localChange;
  }

  /// Whatever happened, once it is put right and tried again the transport is the same to the bit.
  void aFaultIsFoundAndLeavesNoTraceAfterRetry_data() {
    faults_data();
    // It is not the wrong screen whose picture is not seen then, and nothing that stands in the view.
    QTest::newRow("covered lens in the first look")
        << fault(FaultKind::coveredLens, 13) << AlarmKind::coveredLens;
    QTest::newRow("covered lens at full light")
        << fault(FaultKind::coveredLens, 14) << AlarmKind::coveredLens;
  }
  void aFaultIsFoundAndLeavesNoTraceAfterRetry() {
    QFETCH(DeviceFault, fault);
    QFETCH(AlarmKind, kind);
    venue_->faults->faults = {fault};
    std::vector<Alarm> alarms;
    MemoryLog log;
    Acquisition a = venue_->run(
        [&](const Alarm& alarm) {
          alarms.push_back(alarm);
          venue_->faults->faults.clear();
          return Answer::retry;
        },
        log);
    QCOMPARE(alarms.size(), std::size_t{1});
    QVERIFY2(alarms[0].kind == kind, english(alarms[0].what).c_str());
    QVERIFY(!alarms[0].what.empty() && !alarms[0].safe.empty() && !alarms[0].advice.empty());
    QVERIFY(a.transport == venue_->sound().transport);
    QVERIFY(a.black == venue_->sound().black && a.flagged == venue_->sound().flagged);
    QCOMPARE(a.patterns, venue_->sound().patterns);
  }

  /// Law: what moved is told beside another light, and what was photographed since is not called safe by
  /// putting only the light right.
  void aBumpUnderAnotherLightIsTold() {
    venue_->faults->faults = {fault(FaultKind::ambient, 60, 0.05), fault(FaultKind::shiftedCamera, 60, 2.0)};
    std::vector<Alarm> alarms;
    MemoryLog log;
    const Acquisition a = venue_->run(
        [&](const Alarm& alarm) {
          alarms.push_back(alarm);
          if (alarms.size() == 2) venue_->faults->faults.clear();
          if (alarms.size() == 1) venue_->faults->faults.pop_back();  // the light is left on
          return Answer::retry;
        },
        log);
    QCOMPARE(alarms.size(), std::size_t{2});
    QVERIFY2(alarms[0].kind == AlarmKind::moved, english(alarms[0].what).c_str());
    QVERIFY2(english(alarms[0].what).find("room became brighter") != std::string::npos,
             english(alarms[0].what).c_str());
    QVERIFY(alarms[0].first <= 60 && alarms[0].first + alarms[0].patterns > 60);
    QVERIFY2(alarms[1].kind == AlarmKind::ambientChanged, english(alarms[1].what).c_str());
    QVERIFY(a.transport == venue_->sound().transport);
  }

  void aBumpBetweenTwoExposures_data() {
    QTest::addColumn<int>("which");
    QTest::newRow("of a pattern") << 0;
    QTest::newRow("of the reference picture of a check") << 1;
  }
  /// Law: a bump between two photographs of one pattern is told as one, and not as flicker; put right and
  /// tried again, it leaves no trace.
  void aBumpBetweenTwoExposures() {
    QFETCH(int, which);
    venue_->faults->faults.clear();
    MemoryLog sound;
    Listening listening;
    venue_->run({}, sound, listening);
    int shot = 60;
    if (which == 1)
      shot =
          std::ranges::find_if(listening.readings, [](const Reading& one) { return one.shot > 60; })->shot -
          1;
    while (sound.shots.at(shot).frames.size() < 2) ++shot;
    bool isOver = false;
    venue_->before = [&](const CaptureRequest& request) {
      const bool hasBumped =
          request.shot.number > shot || (request.shot.number == shot && request.exposure > 0);
      venue_->faults->faults.clear();
      if (hasBumped && !isOver) venue_->faults->faults = {fault(FaultKind::shiftedCamera, 0, 3.0)};
    };
    std::vector<Alarm> alarms;
    MemoryLog log;
    const Acquisition a = venue_->run(
        [&](const Alarm& alarm) {
          alarms.push_back(alarm);
          isOver = true;
          return Answer::retry;
        },
        log);
    venue_->before = {};
    QCOMPARE(alarms.size(), std::size_t{1});
    QVERIFY2(alarms[0].kind == AlarmKind::moved, english(alarms[0].what).c_str());
    QVERIFY(a.transport == venue_->sound().transport);
  }

  /// What is off before the first pattern of T need not go back: nothing has been measured yet that asks for
  /// it. It says so, and that the light is sound.
  void aBumpBeforeTheFirstLook_data() {
    QTest::addColumn<int>("shot");
    QTest::addColumn<double>("pixels");
    for (int shot : {2, 5, 6, 9, 12, 13, 14})
      for (double pixels : {1.0, 2.0, 5.0})
        QTest::addRow("%g pixels before shot %d", pixels, shot) << shot << pixels;
  }
  void aBumpBeforeTheFirstLook() {
    QFETCH(int, shot);
    QFETCH(double, pixels);
    venue_->faults->faults = {fault(FaultKind::shiftedCamera, shot, pixels)};
    std::vector<Alarm> alarms;
    NoShotLog log;
    Acquisition a = venue_->run(
        [&](const Alarm& alarm) {
          alarms.push_back(alarm);
          for (DeviceFault& bump : venue_->faults->faults) bump.first = 0;  // it is left there
          return Answer::retry;
        },
        log);
    QCOMPARE(alarms.size(), std::size_t{1});
    QVERIFY2(alarms[0].kind == AlarmKind::moved, english(alarms[0].what).c_str());
    QCOMPARE(alarms[0].first, 0);
    QCOMPARE(alarms[0].patterns, 15);
    QVERIFY(english(alarms[0].safe).find("before the light transport") != std::string::npos);
    QVERIFY(english(alarms[0].advice).starts_with("leave it as it is now"));
    QVERIFY(flaggedIn(a) <= flaggedIn(venue_->sound()) + 2);
  }

  void whatIsWrongInTheFirstLook_data() {
    QTest::addColumn<DeviceFault>("fault");
    const auto until = [](DeviceFault fault, int last) {
      fault.last = last;
      return fault;
    };
    QTest::newRow("somebody in a later round's flood") << until(handOver(11), 11);
    QTest::newRow("somebody in the reference picture") << until(handOver(13), 13);
    QTest::newRow("somebody from the start") << until(handOver(0), 14);
    QTest::newRow("light from the start") << until(fault(FaultKind::ambient, 0, 0.05), 14);
    QTest::newRow("camera elsewhere at the start") << until(fault(FaultKind::shiftedCamera, 0, 2.0), 14);
  }
  /// Law: what has gone after the first look is found by the next one, nobody is asked to bring it back, and
  /// trying again measures from the start: it is found once, and leaves no trace.
  void whatIsWrongInTheFirstLook() {
    QFETCH(DeviceFault, fault);
    for (AcquisitionMode mode : {AcquisitionMode::adaptive, AcquisitionMode::multiplexed}) {
      FaultyVenue multiplexed(AcquisitionMode::multiplexed);
      FaultyVenue& venue = mode == AcquisitionMode::adaptive ? *venue_ : multiplexed;
      const Acquisition sound = venue.sound();
      venue.faults->faults = {fault};
      std::vector<Alarm> alarms;
      MemoryLog log;
      const Acquisition a = venue.run(
          [&](const Alarm& alarm) {
            alarms.push_back(alarm);
            venue.faults->faults.clear();
            return alarms.size() < 3 ? Answer::retry : Answer::keepAndStop;
          },
          log);
      QCOMPARE(alarms.size(), std::size_t{1});
      const std::string what = english(alarms[0].what), advice = english(alarms[0].advice);
      QVERIFY2(alarms[0].first == 0, what.c_str());
      QVERIFY2(advice.starts_with("leave it as it is now"), advice.c_str());
      QVERIFY(a.transport == sound.transport);
    }
  }

  void whatGoesLater_data() {
    QTest::addColumn<DeviceFault>("fault");
    QTest::addColumn<QString>("what");
    QTest::newRow("somebody") << handOver(0) << "what stood there is gone";
    QTest::newRow("light") << fault(FaultKind::ambient, 0, 0.05) << "darker";
  }
  /// Law: what stood in the light since the start, and goes, is not said to stand there.
  void whatGoesLater() {
    QFETCH(DeviceFault, fault);
    QFETCH(QString, what);
    fault.last = 100;
    venue_->faults->faults = {fault};
    std::vector<std::string> alarms;
    MemoryLog log;
    venue_->run(
        [&](const Alarm& alarm) {
          alarms.push_back(english(alarm.what) + "; " + english(alarm.advice));
          return Answer::keepAndStop;
        },
        log);
    QCOMPARE(alarms.size(), std::size_t{1});
    QVERIFY2(alarms[0].find(what.toStdString()) != std::string::npos, alarms[0].c_str());
    QVERIFY2(alarms[0].find("measure again") != std::string::npos, alarms[0].c_str());
  }

  /// With nobody to ask it stops; what is kept is safe, and running it again goes on from there.
  void withNobodyToAskItStopsAndCanBeResumed_data() {
    QTest::addColumn<DeviceFault>("fault");
    QTest::newRow("from the first shot on") << fault(FaultKind::mirroredScreen, 0);
    QTest::newRow("found by one photograph") << fault(FaultKind::flicker, 60, 0.1);
    QTest::newRow("found by a check") << fault(FaultKind::shiftedCamera, 60, 2.0);
  }
  void withNobodyToAskItStopsAndCanBeResumed() {
    QFETCH(DeviceFault, fault);
    venue_->faults->faults = {fault};
    MemoryLog log;
    try {
      venue_->run({}, log);
      QFAIL("no error");
    } catch (const Error& error) {
      QVERIFY(error.kind() == ErrorKind::device);
      QVERIFY(!error.advice().empty());
    }
    for (const auto& [number, shot] : log.shots) QVERIFY(number < std::max(1, fault.first));
    venue_->faults->faults.clear();
    Acquisition a = venue_->run({}, log);
    QVERIFY(a.transport == venue_->sound().transport);
  }

  /// A little more light in the room, too little to stop for, is part of e from the next check on.
  void ambientLightIsFollowed() {
    venue_->faults->faults = {fault(FaultKind::ambient, 60, 0.0015)};
    NoShotLog log;
    Acquisition a = venue_->run({}, log);
    auto mean = [](const Stack& stack) {
      return std::accumulate(stack.begin(), stack.end(), 0.0) / static_cast<double>(stack.size());
    };
    double rise = (mean(a.black) - mean(venue_->sound().black)) / mean(venue_->sound().flood);
    QVERIFY2(std::abs(rise / 0.0015 - 1.0) < 0.2, qPrintable(QString::number(rise)));
    QVERIFY2(a.verificationError < 1.2 * venue_->sound().verificationError,
             qPrintable(QString::number(a.verificationError)));
  }

  /// Told as they are taken, readings rise where the light does, in proportion.
  void readingsFollowTheRoomLight() {
    std::vector<double> rises;
    for (double amount : {0.0008, 0.0016}) {
      venue_->faults->faults = {fault(FaultKind::ambient, 60, amount)};
      NoShotLog log;
      Listening listening;
      venue_->run({}, log, listening);
      QVERIFY(listening.retakes.empty() && listening.readings.size() > 2);
      double before = 0.0, after = 0.0;
      int earlier = -1;
      for (const Reading& reading : listening.readings) {
        QVERIFY(reading.shot > earlier && !reading.alarm);
        earlier = reading.shot;
        // The light is followed, not taken for the lamp's nor for a movement.
        QVERIFY2(std::abs(reading.lamp - 1.0) < 0.01, qPrintable(QString::number(reading.lamp)));
        QVERIFY2(reading.view < 0.03, qPrintable(QString::number(reading.view)));
        QVERIFY2(reading.flicker < reading_limit::flicker, qPrintable(QString::number(reading.flicker)));
        (reading.shot <= 60 ? before : after) = reading.roomLight - reading.roomLightAtFirst;
      }
      QVERIFY2(std::abs(before) < 0.1 * after, qPrintable(QString("%1, %2").arg(before).arg(after)));
      const Reading& last = listening.readings.back();
      QVERIFY(std::abs(last.roomLight - last.roomLightExpected) < 0.1 * after);
      rises.push_back(after);
    }
    // Shot noise of the blacks, averaged over 5000 values, is far below.
    QVERIFY2(std::abs(rises[1] / rises[0] - 2.0) < 0.1, qPrintable(QString::number(rises[1] / rises[0])));
  }

  /// An alarm's reading is beyond the limit; what it made doubtful is told as taken again, what was read from
  /// the log is not told twice, and looking on changes nothing.
  void anAlarmIsTold() {
    venue_->faults->faults = {fault(FaultKind::ambient, 60, 0.05)};
    MemoryLog log;
    Listening listening;
    Acquisition a = venue_->run(
        [&](const Alarm&) {
          venue_->faults->faults.clear();
          return Answer::retry;
        },
        log, listening);
    // Before the check that found it, the light contradicted what was seen without it.
    auto isAlarm = [](const Retake& retake) { return retake.reason == RetakeReason::alarm; };
    QCOMPARE(std::count_if(listening.retakes.begin(), listening.retakes.end(), isAlarm), 1);
    QVERIFY(isAlarm(listening.retakes.back()));
    const Retake& retake = listening.retakes.back();
    QVERIFY(retake.alarm == AlarmKind::ambientChanged);
    QVERIFY(retake.shot <= 60 && retake.shot + retake.patterns > 60);
    int sound = 0, alarms = 0;
    for (const Reading& reading : listening.readings) {
      double off = reading.roomLight - reading.roomLightExpected;
      QCOMPARE(off > reading_limit::roomLight, reading.alarm.has_value());
      if (reading.alarm) {
        QVERIFY(reading.alarm == AlarmKind::ambientChanged);
        QCOMPARE(reading.shot, retake.shot + retake.patterns);
        ++alarms;
      } else {
        QVERIFY(reading.shot > sound);
        sound = reading.shot;
      }
    }
    QCOMPARE(alarms, 1);
    // It stays on record: what happened, and how many patterns were taken again from where on.
    QCOMPARE(a.findings.size(), venue_->sound().findings.size() + 1);
    const std::string said = english(a.findings.back());
    for (const std::string& part :
         {std::string("brighter"), std::to_string(retake.patterns), "No. " + std::to_string(retake.shot + 1)})
      QVERIFY2(said.find(part) != std::string::npos, said.c_str());
    QVERIFY(a.transport == venue_->sound().transport);
  }

  /// Level by level, pattern by pattern, none left out; read from a log as well.
  void theTreeIsFollowed() {
    MemoryLog log;
    for (bool isRead : {false, true}) {
      Listening listening;
      venue_->run({}, log, listening);
      QVERIFY2(!listening.growth.empty(), isRead ? "read" : "photographed");
      std::vector<int> levels;
      int through = 0;
      for (const auto& [now, count] : listening.growth) {
        if (now == levels) {
          QCOMPARE(count, through + 1);
        } else {
          QVERIFY(levels.empty() || through == levels.back());
          QVERIFY(now.size() > levels.size() && std::equal(levels.begin(), levels.end(), now.begin()));
          QCOMPARE(count, 0);
          levels = now;
        }
        through = count;
      }
      QCOMPARE(through, levels.back());
    }
  }

  /// A flash between two checks contradicts what was seen before.
  void aContradictionIsTold() {
    DeviceFault flash = handOver(80);
    flash.last = 81;
    flash.kind = FaultKind::flash;
    flash.amount = 20.0;
    venue_->faults->faults = {flash};
    NoShotLog log;
    Listening listening;
    venue_->run([](const Alarm&) { return Answer::skip; }, log, listening);
    auto isIt = [](const Retake& retake) {
      return retake.reason == RetakeReason::contradiction && retake.shot <= 81 &&
             retake.shot + retake.patterns > 80;
    };
    QVERIFY(std::any_of(listening.retakes.begin(), listening.retakes.end(), isIt));
  }

  void skippingGoesOn_data() {
    QTest::addColumn<DeviceFault>("fault");
    QTest::newRow("ambient") << fault(FaultKind::ambient, 60, 0.05);
    QTest::newRow("shifted camera") << fault(FaultKind::shiftedCamera, 60, 2.0);
    QTest::newRow("something in the view") << handOver(60);
  }
  void skippingGoesOn() {
    QFETCH(DeviceFault, fault);
    venue_->faults->faults = {fault};
    std::vector<Alarm> alarms;
    MemoryLog log;
    Acquisition a = venue_->run(
        [&](const Alarm& alarm) {
          alarms.push_back(alarm);
          return Answer::skip;
        },
        log);
    // Put up with once, what is there now is expected from then on; and it is on record.
    QCOMPARE(alarms.size(), std::size_t{1});
    QVERIFY(isAcceptable(alarms[0].kind));
    auto names = [&](const Message& finding) {
      const std::string text = english(finding);
      return text.starts_with("accepted before pattern ") && text.ends_with(english(alarms[0].what));
    };
    QCOMPARE(std::count_if(a.findings.begin(), a.findings.end(), names), 1);
    QVERIFY(a.transport.ownLeaves().blocks() > 0);
    // Read from its log it asks the same again, at the same place, and comes to the same.
    Acquisition again = venue_->run(
        [&](const Alarm& alarm) {
          alarms.push_back(alarm);
          return Answer::skip;
        },
        log);
    QCOMPARE(alarms.size(), std::size_t{2});
    QVERIFY(again.findings == a.findings);
    QVERIFY(again.transport == a.transport);
  }

  /// Law: a bump that somebody puts up with costs the patterns that are taken again, and no more. A quarter
  /// of the pixels is wrong then; to measure these again one by one took fifteen times the patterns of all.
  void aBumpThatIsAcceptedEnds() {
    FaultyVenue dense(AcquisitionMode::multiplexed);
    dense.faults->faults = {fault(FaultKind::shiftedCamera, 40, 2.3)};
    NoShotLog log;
    const Acquisition a = dense.run([](const Alarm&) { return Answer::skip; }, log);
    qInfo("%d patterns, %d without a bump; %zu of %zu flagged, %d measured again", a.patterns,
          dense.sound().patterns, flaggedIn(a), a.flagged.size(), a.remeasured);
    QCOMPARE(a.remeasured, 0);
    QVERIFY(a.patterns < 3 * dense.sound().patterns);
    QVERIFY(!a.findings.empty());
  }

  void keepingEndsWithWhatIsSafe() {
    venue_->faults->faults = {fault(FaultKind::coveredLens, 100)};
    NoShotLog log;
    Acquisition a = venue_->run([&](const Alarm&) { return Answer::keepAndStop; }, log);
    QVERIFY(a.patterns < venue_->sound().patterns);
    QVERIFY(a.transport.ownLeaves().blocks() > 0);
    QVERIFY(std::abs(a.unresolvedEnergy) < 0.01);
    QVERIFY(finestLevel(a.transport) > finestLevel(venue_->sound().transport));
  }

  /// A flash or a hand during a few photographs of a level, gone before the next check.
  void whatPassedByIsMeasuredAgain_data() {
    QTest::addColumn<DeviceFault>("fault");
    DeviceFault hand = handOver(80);
    hand.last = 84;
    QTest::newRow("hand") << hand;
    DeviceFault staying = hand;
    staying.last = 200;
    QTest::newRow("a hand that stays") << staying;
    DeviceFault flash = hand;
    flash.kind = FaultKind::flash;
    flash.amount = 20.0;
    flash.last = 81;
    QTest::newRow("flash") << flash;
  }
  void whatPassedByIsMeasuredAgain() {
    QFETCH(DeviceFault, fault);
    venue_->faults->faults = {fault};
    NoShotLog log;
    Acquisition a = venue_->run([](const Alarm&) { return Answer::skip; }, log);
    qInfo("%d patterns for %d, %d measured again, verification %.4f for %.4f, %zu flagged", a.patterns,
          venue_->sound().patterns, a.remeasured, a.verificationError, venue_->sound().verificationError,
          flaggedIn(a));
    QVERIFY(a.patterns > venue_->sound().patterns || a.remeasured > 0);
    // Longer than taking the same frames again lasts, it is found by verification.
    if (fault.last > 100) QVERIFY(a.remeasured > 0);
    QVERIFY(flaggedIn(a) <= flaggedIn(venue_->sound()) + 2);
    // A hand over 6 % of the view; what is below the flags' limit, a tenth of a pixel's light, may stay:
    // sqrt(0.06) * 0.1 in quadrature with what there is anyway.
    double before = venue_->sound().verificationError;
    QVERIFY(a.verificationError < std::hypot(before, std::sqrt(0.06) * 0.1) + 0.1 * before);
  }

 private:
  std::unique_ptr<FaultyVenue> venue_;
};

QTEST_APPLESS_MAIN(TestSentinels)
#include "test_sentinels.moc"
