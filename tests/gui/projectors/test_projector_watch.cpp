// SPDX-License-Identifier: MIT
#include "projectors/projector_watch.h"

#include <QElapsedTimer>
#include <QUdpSocket>
#include <QtTest>

#include "relucent/base/message.h"
#include "support/fake_projector.h"

using namespace relucent;
using namespace relucent::gui;
using relucent::test::FakeProjector;
using relucent::test::FakeProjectorState;
using relucent::test::ProjectorFault;

namespace {

constexpr int blackFor = 300;
constexpr pjlink::Wanted on{true, false}, black{true, true}, off{false, true};

FakeProjectorState playing() {
  FakeProjectorState state;
  state.power = "1";
  return state;
}

WatchedProjector watched(const FakeProjector& projector, const char* label) {
  pjlink::KeeperSettings settings;
  settings.label = label;
  settings.switchesPower = settings.closesShutter = true;
  settings.soon = std::chrono::seconds(1);
  return {projector.address(), settings};
}

constexpr int anyNotices = 0;

/// From a loopback address, which stands for a computer.
void say(const QByteArray& notice, const char* from, quint16 to) {
  QUdpSocket socket;
  QVERIFY(socket.bind(QHostAddress(from), 0));
  QCOMPARE(socket.writeDatagram(notice, QHostAddress::LocalHost, to), notice.size());
}

}  // namespace

class TestProjectorWatch : public QObject {
  Q_OBJECT

  QStringList warned_;
  void listenTo(const ProjectorWatch& watch) {
    warned_.clear();
    connect(&watch, &ProjectorWatch::warned, this,
            [this](const Message& sentence) { warned_.append(QString::fromStdString(english(sentence))); });
  }

 private slots:
  void whatIsKnownOfEach() {
    FakeProjector left(playing()), right({}, ProjectorFault::closesAtOnce);
    ProjectorWatch watch({watched(left, "left"), watched(right, "right")}, on, blackFor);
    listenTo(watch);
    QVERIFY(!watch.states()[0].wasAsked);
    QTRY_VERIFY(watch.states()[0].wasAsked && watch.states()[1].wasAsked);
    QCOMPARE(watch.states()[0].report->model, std::string("P-1"));
    QVERIFY(!watch.states()[1].report && !watch.states()[1].problem.empty());
    QCOMPARE(watch.states()[1].label, QString("right"));
    QCOMPARE(warned_.size(), 1);
  }

  /// Whoever begins outside his hours switches nothing on, not even for a moment.
  void itBeginsAsIsWanted() {
    FakeProjector projector;
    ProjectorWatch watch({watched(projector, "left")}, off, blackFor);
    QTRY_VERIFY(watch.states()[0].wasAsked);
    QCOMPARE(projector.orders(), QStringList());
    watch.want(on);
    QTRY_COMPARE(projector.orders(), QStringList{"POWR 1"});
  }

  void shuttersCloseWhenBlackLastsAndOpenAtOnce() {
    FakeProjector projector(playing());
    ProjectorWatch watch({watched(projector, "left")}, on, blackFor);
    QTRY_VERIFY(watch.states()[0].wasAsked);
    // Brief black is none: the timer that begins with it is stopped by what follows.
    watch.want(black);
    watch.want(on);
    watch.want(black);
    QTRY_COMPARE(projector.orders(), QStringList{"AVMT 11"});
    watch.want(on);
    QTRY_COMPARE(projector.orders(), (QStringList{"AVMT 11", "AVMT 10"}));
    QTRY_VERIFY(watch.states()[0].report->shutter == pjlink::Shutter{});
  }

  void aClosedShutterStaysClosedWhenPowerChanges() {
    FakeProjector projector(playing());
    ProjectorWatch watch({watched(projector, "left")}, black, blackFor);
    QTRY_COMPARE(projector.orders(), QStringList{"AVMT 11"});
    watch.want(off);
    QTRY_VERIFY(projector.orders().contains("POWR 0"));
    QVERIFY(!projector.orders().contains("AVMT 10"));
  }

  /// The next look would be half a minute away.
  void aNoticeIsAReasonToLookNow() {
    FakeProjector projector(playing());
    ProjectorWatch watch({watched(projector, "left")}, on, blackFor, anyNotices);
    listenTo(watch);
    QTRY_VERIFY(watch.states()[0].wasAsked);
    projector.change([](FakeProjectorState& state) { state.troubles = "020000"; });
    say("%2ERST=020000\r", "127.0.0.1", watch.listensAt());
    QTRY_COMPARE(warned_.size(), 1);
    QVERIFY2(warned_[0].contains("lamp"), qPrintable(warned_[0]));
  }

  /// Anybody may be the projector that is known by a name: it looks later than the other one would have.
  void noticesOfOthersAndGarbageAreNone() {
    FakeProjector left(playing()), right(playing());
    WatchedProjector byNumber = watched(left, "left"), byName = watched(right, "right");
    byNumber.settings.soon = std::chrono::milliseconds(100);
    byName.address.host = "localhost";
    ProjectorWatch watch({byNumber, byName}, on, blackFor, anyNotices);
    listenTo(watch);
    QTRY_VERIFY(watch.states()[0].wasAsked && watch.states()[1].wasAsked);
    const int looks = left.connections(), others = right.connections();
    for (const QByteArray& garbage :
         {QByteArray("%2POWR=9\r"), QByteArray("%1POWR=0\r"), QByteArray(2000, '%')})
      say(garbage, "127.0.0.1", watch.listensAt());
    say("%2POWR=0\r", "127.0.0.2", watch.listensAt());
    QTRY_COMPARE(right.connections(), others + 1);
    QCOMPARE(left.connections(), looks);
    // What it says is asked of the projector, never believed.
    QVERIFY(watch.states()[1].report->power == pjlink::Power::on && warned_.empty());
  }

  void aFloodOfNoticesIsOneReason() {
    FakeProjector projector(playing());
    ProjectorWatch watch({watched(projector, "left")}, on, blackFor, anyNotices);
    QTRY_VERIFY(watch.states()[0].wasAsked);
    const int before = projector.connections();
    QElapsedTimer took;
    took.start();
    while (projector.connections() < before + 2) {
      say("%2POWR=0\r", "127.0.0.1", watch.listensAt());
      QCoreApplication::processEvents();
      QVERIFY(took.elapsed() < 20'000);
    }
    QVERIFY2(took.elapsed() >= 1000, qPrintable(QString::number(took.elapsed())));  // soon
  }

  /// One that says nothing holds up neither the others nor the end.
  void endingIsQuick() {
    FakeProjector left(playing()), silent(playing(), ProjectorFault::silent);
    QElapsedTimer took;
    {
      ProjectorWatch watch({watched(silent, "right"), watched(left, "left")}, on, blackFor);
      QTRY_VERIFY(watch.states()[1].wasAsked);
      QTRY_VERIFY(silent.connections() > 0);
      QVERIFY(!watch.states()[0].wasAsked);
      took.start();
    }
    QVERIFY2(took.elapsed() < 1500, qPrintable(QString::number(took.elapsed())));
  }
};

QTEST_GUILESS_MAIN(TestProjectorWatch)
#include "test_projector_watch.moc"
