// SPDX-License-Identifier: MIT
#include <QtTest>

#include "output/show_streams.h"

using namespace relucent;
using namespace relucent::gui;
using namespace std::chrono_literals;

namespace {

using Phase = LiveState::Phase;

LiveState streamIn(Phase phase, int losses = 0, QSize size = {}, std::uint64_t opening = 1) {
  LiveState state{opening, "rtsp://camera/live", phase};
  if (losses > 0) state.problem = Message::plain("the connection was refused; start the sender");
  state.losses = losses;
  state.size = size;
  return state;
}

}  // namespace

class TestShowStreams : public QObject {
  Q_OBJECT

  StreamTeller teller_;
  StreamTeller::Time now_{};
  /// What is said a second later; "!" before a warning.
  QStringList said(const LiveState& state) {
    now_ += 1s;
    QStringList lines;
    for (const StreamTeller::Line& line : teller_.news({state}, now_))
      lines.append((line.isWarning ? "!" : "") + QString::fromStdString(english(line.sentence)));
    return lines;
  }

 private slots:
  void init() { teller_ = {}; }

  void eachLossAndEachReturnIsToldOnce() {
    const QSize size(64, 48);
    QCOMPARE(said(streamIn(Phase::connecting)), QStringList{"connecting to rtsp://camera/live"});
    QCOMPARE(said(streamIn(Phase::connecting)), QStringList{});
    QCOMPARE(said(streamIn(Phase::playing, 0, size)), QStringList{"rtsp://camera/live plays, 64x48"});
    QCOMPARE(said(streamIn(Phase::playing, 0, size)), QStringList{});
    QCOMPARE(
        said(streamIn(Phase::lost, 1, size)),
        QStringList{"!rtsp://camera/live is lost: the connection was refused; start the sender; its last "
                    "picture stays until it is back"});
    for (int attempt = 0; attempt < 3; ++attempt)
      QCOMPARE(said(streamIn(Phase::lost, 1, size)), QStringList{});
    QCOMPARE(said(streamIn(Phase::playing, 1, size)), QStringList{"rtsp://camera/live is back after 4 s"});
    QCOMPARE(said(streamIn(Phase::playing, 1, size)), QStringList{});
  }

  void aShortLossIsToldToo() {
    said(streamIn(Phase::playing, 0, {64, 48}));
    const QStringList lines = said(streamIn(Phase::playing, 1, {64, 48}));
    QCOMPARE(lines.size(), 2);
    QVERIFY(lines[0].startsWith("!rtsp://camera/live is lost") && lines[1].contains("back after 0 s"));
  }

  void whatTurnsBlackIsSaidSo() {
    LiveState state = streamIn(Phase::lost, 1);
    state.turnsBlack = true;
    QVERIFY(said(state).last().endsWith("black until it is back"));
  }

  void anotherSizeIsTold() {
    said(streamIn(Phase::playing, 0, {64, 48}));
    QCOMPARE(said(streamIn(Phase::playing, 0, {96, 64})),
             QStringList{"rtsp://camera/live has another size now: 96x64"});
  }

  /// In a list it is opened in every round.
  void openedAgainItIsNotToldAgain() {
    said(streamIn(Phase::playing, 0, {64, 48}, 1));
    QCOMPARE(said(streamIn(Phase::connecting, 0, {}, 2)), QStringList{});
    QCOMPARE(said(streamIn(Phase::playing, 0, {64, 48}, 2)), QStringList{});
    QCOMPARE(said(streamIn(Phase::lost, 1, {64, 48}, 2)).size(), 1);
    QCOMPARE(said(streamIn(Phase::lost, 1, {}, 3)), QStringList{});
    QCOMPARE(said(streamIn(Phase::playing, 1, {64, 48}, 3)),
             QStringList{"rtsp://camera/live is back after 2 s"});
    QCOMPARE(said(streamIn(Phase::lost, 2, {64, 48}, 3)).size(), 1);
  }

  void healthHasWhatIsKnown() {
    LiveState state = streamIn(Phase::playing, 1, {64, 48});
    QJsonObject object = toJson(std::vector{state})[0].toObject();
    QCOMPARE(object["address"].toString(), QString("rtsp://camera/live"));
    QCOMPARE(object["state"].toString(), QString("playing"));
    QCOMPARE(object["size"].toString(), QString("64x48"));
    QCOMPARE(object["losses"].toInt(), 1);
    QVERIFY(!object.contains("problem") && !object.contains("sender_milliseconds"));
    state.phase = Phase::lost;
    QVERIFY(toJson(std::vector{state})[0].toObject()["problem"].toString().contains("refused"));
  }

  /// Clocks that disagree tell nothing.
  void onlyATimeThatCanBeIsTold_data() {
    QTest::addColumn<double>("seconds");
    QTest::addColumn<bool>("told");
    QTest::newRow("a way") << 0.25 << true;
    QTest::newRow("before it was sent") << -0.25 << false;
    QTest::newRow("an hour") << 3600.0 << false;
  }
  void onlyATimeThatCanBeIsTold() {
    QFETCH(double, seconds);
    QFETCH(bool, told);
    LiveState state = streamIn(Phase::playing, 0, {64, 48});
    state.senderSeconds = seconds;
    const QJsonObject object = toJson(std::vector{state})[0].toObject();
    QCOMPARE(object.contains("sender_milliseconds"), told);
    if (told) QCOMPARE(object["sender_milliseconds"].toDouble(), 250.0);
  }
};

QTEST_GUILESS_MAIN(TestShowStreams)
#include "test_show_streams.moc"
