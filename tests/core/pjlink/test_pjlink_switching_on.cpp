// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/base/error.h"
#include "relucent/pjlink/switching_on.h"
#include "support/fake_projector.h"
#include "support/sentences.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::pjlink;
using relucent::test::FakeProjector;
using relucent::test::FakeProjectorState;
using relucent::test::ProjectorFault;

class TestPjlinkSwitchingOn : public QObject {
  Q_OBJECT

  Waiting::Time now_{};
  Waiting waiting_{[this] { return now_; }, [this](std::chrono::milliseconds time) { now_ += time; }};

  std::vector<Message> switchedOn(const std::vector<Named>& projectors) {
    Progress quiet;
    SwitchingOnSettings settings;
    settings.patience = {std::chrono::milliseconds(300), std::chrono::milliseconds(300)};
    return switchOn(projectors, settings, waiting_, quiet);
  }

 private slots:
  void allAreOnAfterwards_data() {
    QTest::addColumn<QString>("power");
    QTest::addColumn<QString>("shutter");
    QTest::addColumn<QStringList>("orders");
    QTest::newRow("in standby") << "0"
                                << "30" << QStringList{"POWR 1"};
    QTest::newRow("on") << "1"
                        << "30" << QStringList{};
    QTest::newRow("warming up") << "3"
                                << "30" << QStringList{};
    QTest::newRow("cooling down") << "2"
                                  << "30" << QStringList{"POWR 1"};
    QTest::newRow("shut") << "1"
                          << "31" << QStringList{"AVMT 10"};
    QTest::newRow("in standby and shut") << "0"
                                         << "11" << QStringList{"POWR 1", "AVMT 10"};
    QTest::newRow("only the sound off") << "1"
                                        << "21" << QStringList{};
  }
  void allAreOnAfterwards() {
    QFETCH(QString, power);
    QFETCH(QString, shutter);
    QFETCH(QStringList, orders);
    FakeProjectorState state;
    state.power = power.toLatin1();
    state.shutter = shutter.toLatin1();
    FakeProjector left(state), right;
    QVERIFY(switchedOn({{"left", left.address()}, {"right", right.address()}}).empty());
    for (const FakeProjector* one : {&left, &right}) QCOMPARE(one->state().power, QByteArray("1"));
    QCOMPARE(left.orders(), orders);
    QCOMPARE(right.orders(), QStringList{"POWR 1"});
  }

  void whatSpoilsAMeasurementIsTold() {
    FakeProjectorState state;
    state.signal = "1280x720";
    FakeProjector projector(state);
    const std::vector<Message> remarks = switchedOn({{"left", projector.address()}});
    QCOMPARE(remarks.size(), std::size_t{1});
    QVERIFY(mentions(english(remarks[0]), "receives 1280x720 pixels and has 1920x1080"));
  }

  void failuresNameTheProjector_data() {
    QTest::addColumn<ProjectorFault>("fault");
    QTest::addColumn<QString>("power");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("says on and stays off")
        << ProjectorFault::saysOnStaysOff << "0"
        << "projector right was told to switch on and is not on after 300 s";
    QTest::newRow("silent") << ProjectorFault::silent << "0"
                            << "does not answer";
    QTest::newRow("a failure of its own") << ProjectorFault::failure << "0"
                                          << "is not on after 300 s";
    QTest::newRow("garbage") << ProjectorFault::garbage << "0"
                             << "is not on after 300 s";
    QTest::newRow("shutter stays closed") << ProjectorFault::shutterSaysOk << "1"
                                          << "the shutter of projector right does not open";
  }
  void failuresNameTheProjector() {
    QFETCH(ProjectorFault, fault);
    QFETCH(QString, power);
    QFETCH(QString, sentence);
    FakeProjectorState state;
    state.power = power.toLatin1();
    state.shutter = "31";
    FakeProjector left, right(state, fault);
    const std::string said = sentenceOf(
        [&] { switchedOn({{"left", left.address()}, {"right", right.address()}}); }, ErrorKind::device);
    QVERIFY(mentions(said, sentence.toStdString()));
    QVERIFY(mentions(said, toString(right.address())));
  }

  void aLampThatNeverWarmsUpIsTold() {
    FakeProjectorState state;
    state.looksUntilWarm = 1000;
    FakeProjector projector(state);
    QVERIFY(mentions(sentenceOf([&] { switchedOn({{"left", projector.address()}}); }, ErrorKind::device),
                     "projector left is still warming up or cooling down after 300 s"));
  }

  /// A network card wakes up with its projector.
  void oneMissIsForgiven() {
    FakeProjector projector({}, ProjectorFault::closesAtOnce);
    waiting_.sleep = [&](std::chrono::milliseconds time) {
      now_ += time;
      projector.setFault(ProjectorFault::none);
    };
    QVERIFY(switchedOn({{"left", projector.address()}}).empty());
    QCOMPARE(projector.state().power, QByteArray("1"));
  }

  void stoppingEndsIt() {
    FakeProjector projector;
    Stopped stopped;
    QVERIFY_EXCEPTION_THROWN(switchOn({{"left", projector.address()}}, {}, waiting_, stopped), Cancelled);
  }
};

QTEST_GUILESS_MAIN(TestPjlinkSwitchingOn)
#include "test_pjlink_switching_on.moc"
