// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/base/error.h"
#include "relucent/pjlink/keeper.h"
#include "support/fake_projector.h"

using namespace relucent;
using namespace relucent::pjlink;
using relucent::test::FakeProjector;
using relucent::test::FakeProjectorState;
using relucent::test::ProjectorFault;

namespace {

constexpr Patience shortPatience{std::chrono::milliseconds(300), std::chrono::milliseconds(300)};

FakeProjectorState playing() {
  FakeProjectorState state;
  state.power = "1";
  state.lamps = "1234 1";
  return state;
}

/// A projector looked after at the times that its keeper wishes.
struct KeptProjector {
  Keeper keeper;
  Keeper::Time now{};
  QStringList told, warned;
  Kept last;

  KeptProjector(const FakeProjector& projector, KeeperSettings settings)
      : keeper(projector.address(), [&settings] {
          settings.label = "left";
          settings.patience = shortPatience;
          return settings;
        }()) {}

  void keep(const Wanted& wanted, int times = 1) {
    Progress quiet;
    for (int i = 0; i < times; ++i) {
      last = keeper.keep(wanted, now, quiet);
      for (const Message& message : last.told) told.append(QString::fromStdString(english(message)));
      for (const Message& message : last.warned) warned.append(QString::fromStdString(english(message)));
      now += last.pause;
    }
  }
};

constexpr Wanted on{true, false}, off{false, false}, black{true, true};

}  // namespace

class TestPjlinkKeeper : public QObject {
  Q_OBJECT

 private slots:
  void powerFollowsTheShow() {
    FakeProjector projector;
    KeptProjector kept(projector, {.label = {}, .switchesPower = true});
    kept.keep(on);
    QCOMPARE(projector.orders(), QStringList{"POWR 1"});
    QCOMPARE(kept.last.pause, KeeperSettings().soon);
    kept.keep(on, 5);
    QVERIFY(kept.last.report->power == Power::on);
    QCOMPARE(kept.last.pause, KeeperSettings().interval);
    QCOMPARE(projector.orders(), QStringList{"POWR 1"});
    kept.keep(off, 6);
    QVERIFY(kept.last.report->power == Power::off);
    QCOMPARE(projector.orders(), (QStringList{"POWR 1", "POWR 0"}));
    kept.keep(on, 6);
    QCOMPARE(kept.told, (QStringList{"projector left was switched on", "projector left was switched off",
                                     "projector left was switched on"}));
    QCOMPARE(kept.warned, QStringList());
  }

  /// On again while it cools down: it has to come to an end first.
  void aCoolingProjectorIsWaitedFor() {
    FakeProjectorState state;
    state.power = "2";
    FakeProjector projector(state);
    KeptProjector kept(projector, {.label = {}, .switchesPower = true});
    kept.keep(on, 10);
    QVERIFY(kept.last.report->power == Power::on);
    QCOMPARE(projector.orders(), QStringList{"POWR 1"});
  }

  void whoIsOnlyWatchedIsNeverTouched() {
    FakeProjectorState state;
    state.shutter = "31";
    FakeProjector projector(state);
    KeptProjector kept(projector, {});
    kept.keep(on, 3);
    QCOMPARE(kept.warned, QStringList{"projector left is switched off"});
    projector.change([](FakeProjectorState& changed) { changed.power = "1"; });
    kept.keep(on, 3);
    QCOMPARE(kept.warned.size(), 2);
    QVERIFY(kept.warned.last().contains("shutter of projector left is closed"));
    kept.keep(black, 3);
    kept.keep(off, 3);
    QCOMPARE(kept.warned.size(), 2);
    QCOMPARE(projector.orders(), QStringList());
  }

  void theShutterFollowsBlack() {
    FakeProjector projector(playing());
    KeptProjector kept(projector, {.label = {}, .closesShutter = true});
    kept.keep(on, 2);
    QCOMPARE(projector.orders(), QStringList());
    kept.keep(black, 2);
    QCOMPARE(projector.orders(), QStringList{"AVMT 11"});
    QVERIFY(kept.last.report->shutter->picture);
    QCOMPARE(kept.last.pause, KeeperSettings().interval);
    kept.keep(on, 2);
    QCOMPARE(projector.orders(), (QStringList{"AVMT 11", "AVMT 10"}));
    QCOMPARE(kept.warned, QStringList());
  }

  /// Each lie and fault: what is told, each once, and what is done however often it fails.
  void faultsAreToldOnce_data() {
    QTest::addColumn<ProjectorFault>("fault");
    QTest::addColumn<QString>("power");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("stays off") << ProjectorFault::saysOnStaysOff << "0"
                               << "was told to switch on and does not";
    QTest::newRow("no shutter") << ProjectorFault::noShutter << "1"
                                << "has no shutter that the network closes";
    QTest::newRow("garbage") << ProjectorFault::garbage << "1"
                             << "in a way that is no PJLink";
    QTest::newRow("a failure of its own") << ProjectorFault::failure << "0"
                                          << "";
    QTest::newRow("half lines") << ProjectorFault::halfLine << "1"
                                << "does not answer";
    QTest::newRow("silent") << ProjectorFault::silent << "1"
                            << "does not answer";
    QTest::newRow("closes") << ProjectorFault::closesMidAnswer << "1"
                            << "does not answer";
    QTest::newRow("another protocol") << ProjectorFault::otherProtocol << "1"
                                      << "does not speak PJLink";
  }
  void faultsAreToldOnce() {
    QFETCH(ProjectorFault, fault);
    QFETCH(QString, power);
    QFETCH(QString, sentence);
    FakeProjectorState state = playing();
    state.power = power.toLatin1();
    FakeProjector projector(state, fault);
    KeptProjector kept(
        projector,
        {.label = {}, .switchesPower = true, .closesShutter = true, .obeys = std::chrono::seconds(10)});
    kept.keep(black, 8);
    QCOMPARE(kept.warned.size(), sentence.isEmpty() ? 0 : 1);
    if (!sentence.isEmpty()) QVERIFY2(kept.warned[0].contains(sentence), qPrintable(kept.warned[0]));
  }

  void aProjectorThatLiesAboutItsShutterIsToldAgain() {
    FakeProjector projector(playing(), ProjectorFault::shutterSaysOk);
    KeptProjector kept(projector, {.label = {}, .closesShutter = true});
    kept.keep(black, 3);
    QCOMPARE(projector.orders(), (QStringList{"AVMT 11", "AVMT 11", "AVMT 11"}));
    QVERIFY(!kept.last.report->shutter->picture);
  }

  void whatDoesNotAnswerIsAskedLessAndLess() {
    FakeProjector projector(playing(), ProjectorFault::closesAtOnce);
    KeptProjector kept(projector, {.label = {}, .longestPause = std::chrono::seconds(20)});
    std::vector<int> pauses;
    for (int i = 0; i < 5; ++i) {
      kept.keep(on);
      QVERIFY(!kept.last.problem.empty() && !kept.last.report);
      pauses.push_back(static_cast<int>(kept.last.pause.count() / 1000));
    }
    QCOMPARE(pauses, (std::vector<int>{3, 6, 12, 20, 20}));
    QCOMPARE(kept.warned.size(), 1);
    projector.setFault(ProjectorFault::none);
    kept.keep(on);
    QCOMPARE(kept.told, QStringList{"projector left answers again"});
    QVERIFY(kept.last.problem.empty());
    projector.setFault(ProjectorFault::closesAtOnce);
    kept.keep(on);
    QCOMPARE(kept.warned.size(), 2);
    QCOMPARE(kept.last.pause, KeeperSettings().soon);
  }

  void whatIsWrongIsToldOnceWhileItLasts() {
    FakeProjectorState state = playing();
    state.troubles = "020010";
    state.signal = "1280x720";
    state.frozen = "1";
    FakeProjector projector(state);
    KeptProjector kept(projector, {.label = {}, .sent = Size{1920, 1080}});
    kept.keep(on, 4);
    QCOMPARE(kept.warned.size(), 5);
    QCOMPARE(kept.warned[0], QString("projector left reports an error: lamp"));
    QCOMPARE(kept.warned[1], QString("projector left warns: filter"));
    QVERIFY(kept.warned[2].contains("freezes its picture"));
    QVERIFY(kept.warned[3].contains("receives 1280x720 pixels and has 1920x1080"));
    QVERIFY(kept.warned[4].contains("where 1920x1080 are sent"));
    projector.change([](FakeProjectorState& changed) { changed.troubles = "000010"; });
    kept.keep(on, 2);
    QCOMPARE(kept.warned.size(), 5);
    projector.change([](FakeProjectorState& changed) { changed.troubles = "020010"; });
    kept.keep(on, 2);
    QCOMPARE(kept.warned.size(), 6);
    projector.change([](FakeProjectorState& changed) { changed.signal = "-"; });
    kept.keep(on, 2);
    QCOMPARE(kept.warned.size(), 7);
    QVERIFY(kept.warned[6].contains("has no signal at its input HDMI 1"));
  }
};

QTEST_GUILESS_MAIN(TestPjlinkKeeper)
#include "test_pjlink_keeper.moc"
