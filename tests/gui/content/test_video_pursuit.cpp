// SPDX-License-Identifier: MIT
// What a film's player is told to do, on a clock of the test's own.
#include <QtTest>

#include "content/video_follower.h"

using namespace relucent;
using namespace relucent::gui;
using namespace std::chrono_literals;

namespace {

/// A player that does as it is told, with faults.
struct Player {
  VideoPursuit pursuit{60s};
  VideoTime::Clock::time_point now{1h};
  ContentTime position{0};
  double speed = 1.0;
  int seeks = 0;
  bool playing = false;
  std::optional<ContentTime> shown;  // none: what is at its position
  bool hasPicture = true;

  void tick(const VideoTime::Asked& asked) {
    now += 15ms;
    if (playing) position += std::chrono::duration_cast<ContentTime>(15ms * speed);
    VideoStep step = pursuit.next(asked, {position, hasPicture, shown}, now);
    playing = step.play;
    if (step.seek) {
      position = *step.seek;
      ++seeks;
    }
  }
  /// Asked for running time, 25 times a second.
  void run(ContentTime from, std::chrono::milliseconds howLong) {
    VideoTime::Clock::time_point begin = now;
    VideoTime::Asked asked;
    for (int i = 0; now - begin < howLong; ++i) {
      if (i % 3 == 0) asked = {from + std::chrono::duration_cast<ContentTime>(now - begin), now};
      tick(asked);
    }
  }
};

}  // namespace

class TestVideoPursuit : public QObject {
  Q_OBJECT

 private slots:
  void nobodyAsksNothingPlays() {
    Player player;
    for (int i = 0; i < 100; ++i) player.tick({});
    QVERIFY(!player.playing && player.position == 0s && player.seeks == 0);
  }

  void runsWithTheTimeWithoutJumping() {
    Player player;
    player.run(0s, 20s);
    QVERIFY(player.playing);
    QCOMPARE(player.seeks, 0);
    QVERIFY(std::chrono::abs(player.position - 20s) < 100ms);
  }

  void beginsAnywhere() {
    Player player;
    player.run(30s, 2s);
    QCOMPARE(player.seeks, 1);
    QVERIFY(std::chrono::abs(player.position - 32s) < 100ms);
  }

  /// A sound card's clock that is off by a lot: brought back, a jump every now and then, never far astray.
  void aWrongClockIsBroughtBack_data() {
    QTest::addColumn<double>("speed");
    QTest::newRow("slow") << 0.99;
    QTest::newRow("quick") << 1.01;
  }
  void aWrongClockIsBroughtBack() {
    QFETCH(double, speed);
    Player player;
    player.speed = speed;
    player.run(0s, 50s);
    QVERIFY(player.seeks >= 2 && player.seeks <= 4);  // 0.5 s in all, 0.14 s each
    QVERIFY(std::chrono::abs(player.position - 50s) < 200ms);
  }

  void standsWhileTheTimeStands() {
    Player player;
    player.run(0s, 2s);
    for (int i = 0; i < 200; ++i) player.tick({2s, player.now});
    QVERIFY(!player.playing);
    QVERIFY(std::chrono::abs(player.position - 2s) < 250ms);
    player.run(2s, 3s);
    QVERIFY(player.playing && std::chrono::abs(player.position - 5s) < 200ms);
  }

  /// A player that was told to jump while it stood, and shows the old picture all the same: told again, and
  /// not for ever, as some films number their pictures otherwise.
  void aJumpThatDidNotComeIsTriedAgain() {
    Player player;
    player.run(0s, 5s);
    int before = player.seeks;
    player.shown = player.position;
    for (int i = 0; i < 1000; ++i) player.tick({40s, player.now});
    QVERIFY(player.seeks - before >= 2 && player.seeks - before <= 5);
    player.shown = 40s;
    before = player.seeks;
    for (int i = 0; i < 1000; ++i) player.tick({40s, player.now});
    QCOMPARE(player.seeks, before);
  }

  /// A player that was paused and shows no first picture: told again until one comes, at its beginning.
  void aFirstPictureThatDoesNotComeIsAskedForAgain() {
    Player player;
    player.hasPicture = false;
    for (int i = 0; i < 120; ++i) player.tick({});
    QCOMPARE(player.seeks, 0);  // 1.8 s: a disk may be slow
    for (int i = 0; i < 840; ++i) player.tick({});
    QCOMPARE(player.seeks, 3);  // 14.4 s: after 2, 6 and 14
    QVERIFY(!player.playing && player.position == 0s);
    player.hasPicture = true;
    const int before = player.seeks;
    player.run(0s, 5s);
    QCOMPARE(player.seeks, before);
  }

  void stopsWhenNobodyShowsItAnyMore() {
    Player player;
    player.run(0s, 2s);
    VideoTime::Asked last{2s, player.now};
    for (int i = 0; i < 200; ++i) player.tick(last);
    QVERIFY(!player.playing && player.position < 3s);
  }

  void beginsAnewWhenTheTimeDoes() {
    Player player;
    for (int round = 0; round < 3; ++round) player.run(0s, 10s);
    QCOMPARE(player.seeks, 2);
    QVERIFY(std::chrono::abs(player.position - 10s) < 200ms);
  }

  void theLastPictureStaysBehindTheEnd() {
    Player player;
    player.run(55s, 20s);
    QVERIFY(!player.playing && player.position <= 60s + 100ms);
  }
};

QTEST_GUILESS_MAIN(TestVideoPursuit)
#include "test_video_pursuit.moc"
