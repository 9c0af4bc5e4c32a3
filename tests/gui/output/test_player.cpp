// SPDX-License-Identifier: MIT
// Runs on two screens that can be unplugged, see tests/support/with-two-screens.
#include "output/player.h"
#include "relucent/base/message.h"

#include <QScopeGuard>
#include <QSignalSpy>
#include <QtTest>
#include <atomic>

#include "content/still_image.h"
#include "gui/output/scripted_renderer.h"
#include "gui/output/two_screens.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;
using namespace std::chrono_literals;

namespace {

/// A grey that says what time it is: a tenth of a second a step, or as long as each picture stands.
class Film : public ContentSource {
 public:
  explicit Film(ContentTime each = 100ms) : each_(each) {}
  ContentPicture at(ContentTime time) override {
    auto step = static_cast<std::uint64_t>(time / each_);
    time -= time % each_;
    QImage image(projectorSize, QImage::Format_RGBX8888);
    image.fill(greyAt(time));
    return {image, step + 1};
  }
  std::optional<ContentTime> length() const override { return std::nullopt; }
  static QColor greyAt(ContentTime time) {
    int grey = static_cast<int>(time / 100ms) % 256;
    return {grey, grey, grey};
  }

 private:
  ContentTime each_;
};

/// A clock that the test turns. Renderers look at it from their thread.
struct Hand {
  class Time {
   public:
    void operator=(std::chrono::steady_clock::time_point time) { since_ = time.time_since_epoch(); }
    void operator+=(std::chrono::steady_clock::duration more) { since_ = since_.load() + more; }
    operator std::chrono::steady_clock::time_point() const {
      return std::chrono::steady_clock::time_point(since_.load());
    }

   private:
    std::atomic<std::chrono::steady_clock::duration> since_{};
  } now;
  ContentClock clock() {
    return ContentClock([this]() -> std::chrono::steady_clock::time_point { return now; });
  }
};

QRgb seen() {
  return seenOn("DUMMY1").pixel(500, 400) | 0xff000000u;
}

}  // namespace

class TestPlayer : public QObject {
  Q_OBJECT

  std::unique_ptr<ProjectorWindow> window_;
  ScriptedRenderer* renderer_ = nullptr;  // the player's
  Hand hand_;

  std::unique_ptr<Player> playerOf(std::shared_ptr<ContentSource> content,
                                   std::vector<Position> cameras = {}) {
    auto renderer = std::make_unique<ScriptedRenderer>();
    renderer->positions = std::move(cameras);
    renderer_ = renderer.get();
    hand_.now = std::chrono::steady_clock::time_point();
    return std::make_unique<Player>(std::move(renderer), std::move(content),
                                    std::vector<ProjectorWindow*>{window_.get()}, hand_.clock());
  }
  std::shared_ptr<ContentSource> still() {
    return std::make_shared<StillImage>(noise(projectorSize, 3).convertToFormat(QImage::Format_RGBX8888),
                                        Canvas{projectorSize, Fit::fill});
  }

 private slots:
  void init() {
    if (screenOn("DUMMY1") == nullptr) plug();
    window_ = std::make_unique<ProjectorWindow>(projector);
    window_->shine();
    QTRY_VERIFY(window_->isExposed());
  }
  void cleanup() { window_.reset(); }

  /// The picture is for him at once, glides home when he is not heard of, and then stands.
  void aViewerIsFollowedUntilHeIsSilent() {
    auto player = playerOf(still(), {{0, 0, 0}, {2, 0, 0}});
    player->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QVERIFY(player->canFollowViewers() && player->cameras().size() == 2 && !player->viewer());
    QCOMPARE(player->statistics().viewerSeconds, 0.0);
    QVERIFY(player->moveViewer({1.5, 0, 0}));
    QTRY_VERIFY(renderer_->presence == 1.0 && renderer_->viewerX == 1.5);
    QVERIFY(player->viewer() == FrameViewer({{1.5, 0, 0}, 1.0}));
    QTRY_VERIFY(player->statistics().viewerSeconds > 0.0);
    // He stands: as well as possible, and no more.
    hand_.now += 1s;
    QTRY_VERIFY(renderer_->thorough && renderer_->presence == 1.0);
    hand_.now += 2s;
    QTRY_VERIFY(std::abs(renderer_->presence - std::exp(-1.0)) < 1e-6 && renderer_->viewerX == 1.5);
    hand_.now += 1h;
    QTRY_VERIFY(renderer_->presence == 0.0);
    QVERIFY(!player->viewer());
    hand_.now += 1s;
    QTRY_VERIFY(renderer_->thorough);
    const int rendered = renderer_->rendered;
    for (int turns = 0; turns < 200; ++turns) QCoreApplication::processEvents();
    QCOMPARE(renderer_->rendered.load(), rendered);
    QVERIFY(!player->moveViewer({std::nan(""), 0, 0}));
    QVERIFY(!player->viewer());
  }

  /// Also while the best of a picture is being computed, which takes as long as it likes.
  void aViewerDoesNotWaitForThePictureBefore() {
    auto player = playerOf(still(), {{0, 0, 0}, {2, 0, 0}});
    renderer_->endless = true;
    player->start();
    QTRY_COMPARE(renderer_->rendered.load(), 1);
    hand_.now += 1s;
    QTRY_COMPARE(renderer_->rendered.load(), 2);
    QVERIFY(player->moveViewer({0.5, 0, 0}));
    QTRY_VERIFY(renderer_->presence == 1.0 && renderer_->viewerX == 0.5);
    renderer_->endless = false;
  }

  /// Frames go on while a set is prepared, however long that takes; the newest wish is the one that is shown.
  void aSetIsPreparedBesideTheFrames() {
    auto player = playerOf(std::make_shared<Film>());
    QSignalSpy shown(player.get(), &Player::setShown), failed(player.get(), &Player::setFailed);
    player->start();
    QTRY_COMPARE(renderer_->rendered.load(), 1);
    const auto release = qScopeGuard([this] { renderer_->holdsPreparing = false; });  // or nobody ends
    renderer_->holdsPreparing = true;
    player->useSet("night");
    player->useSet("day");  // somebody has changed his mind
    for (int turn = 0; turn < 5; ++turn) {
      const int before = renderer_->rendered;
      hand_.now += 100ms;
      QTRY_VERIFY(renderer_->rendered > before);
      QVERIFY(!player->set() && shown.isEmpty());
    }
    renderer_->holdsPreparing = false;
    QTRY_COMPARE(shown.size(), 1);
    QCOMPARE(shown[0][0].value<std::string>(), std::string("day"));
    QCOMPARE(renderer_->set, std::string("day"));
    QVERIFY(player->set() == "day" && failed.isEmpty());
    QCOMPARE(renderer_->prepared.load(), 2);
    // Of the one that plays nothing is prepared.
    player->useSet("day");
    QVERIFY(player->set() == "day");
    // What is prepared ahead is shown from the next frame on.
    player->prepareSet("night");
    QTRY_COMPARE(renderer_->prepared.load(), 3);
    QVERIFY(player->set() == "day");
    for (int turns = 0; turns < 50; ++turns) QCoreApplication::processEvents();
    renderer_->holdsPreparing = true;
    player->useSet("night");
    QVERIFY(player->set() == "night");
    QTRY_COMPARE(shown.size(), 2);
    QCOMPARE(renderer_->prepared.load(), 3);
  }

  /// A set that cannot be had changes nothing but a sentence, which is told to whoever wants it.
  void aSetThatCannotBeHadIsTold() {
    auto player = playerOf(still());
    QSignalSpy shown(player.get(), &Player::setShown), failed(player.get(), &Player::setFailed);
    player->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    player->prepareSet("gone");
    QTRY_COMPARE(renderer_->prepared.load(), 1);
    for (int turns = 0; turns < 50; ++turns) QCoreApplication::processEvents();
    QVERIFY(failed.isEmpty());
    player->useSet("gone");
    QTRY_COMPARE(failed.size(), 1);
    QVERIFY(QString::fromStdString(english(failed[0][1].value<Message>())).contains("no set 'gone'"));
    QVERIFY(!player->set() && shown.isEmpty() && player->isPlaying());
    QVERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
  }

  void keysWalk_data() {
    QTest::addColumn<int>("key");
    QTest::addColumn<int>("axis");
    QTest::addColumn<double>("step");
    QTest::newRow("left") << int(Qt::Key_Left) << 0 << -0.1;
    QTest::newRow("right") << int(Qt::Key_Right) << 0 << 0.1;
    QTest::newRow("down") << int(Qt::Key_Down) << 1 << -0.1;
    QTest::newRow("up") << int(Qt::Key_Up) << 1 << 0.1;
    QTest::newRow("page down") << int(Qt::Key_PageDown) << 2 << -0.1;
    QTest::newRow("page up") << int(Qt::Key_PageUp) << 2 << 0.1;
  }
  /// From the middle of the cameras on.
  void keysWalk() {
    QFETCH(int, key);
    QFETCH(int, axis);
    QFETCH(double, step);
    auto player = playerOf(still(), {{0, 4, 1}, {2, 4, 1}});
    Position expected{1, 4, 1};
    for (int steps = 0; steps < 3; ++steps) {
      QVERIFY(player->handleKey(key));
      expected[static_cast<std::size_t>(axis)] += step;
      const Position at = player->viewer().value().position;
      for (std::size_t k = 0; k < 3; ++k) QVERIFY(std::abs(at[k] - expected[k]) < 1e-12);
    }
    QVERIFY(player->handleKey(Qt::Key_Home) && !player->viewer());
  }

  /// From edge to edge it is as far as the cameras are apart. Without its button the mouse moves nobody.
  void theMouseWalks() {
    auto player = playerOf(still(), {{0, 4, 1}, {2, 4, 1}});
    const QPoint from(window_->width() / 2, window_->height() / 2),
        by(window_->width() / 4, -window_->height() / 8);
    QTest::mouseMove(window_.get(), from);
    QTest::mouseMove(window_.get(), from + by);
    QVERIFY(!player->viewer());
    QTest::mousePress(window_.get(), Qt::LeftButton, {}, from);
    QTest::mouseMove(window_.get(), from + by / 2);
    QTest::mouseMove(window_.get(), from + by);
    QTest::mouseRelease(window_.get(), Qt::LeftButton, {}, from + by);
    QTRY_VERIFY(player->viewer());
    const Position at = player->viewer()->position;
    QVERIFY(std::abs(at[0] - 1.5) < 0.01 && std::abs(at[1] - 4.25) < 0.01 && at[2] == 1.0);
    QTest::mouseMove(window_.get(), from);
    QCOMPARE(player->viewer()->position, at);
  }

  void withoutPlacesNobodyIsFollowed() {
    auto player = playerOf(still());
    QVERIFY(!player->canFollowViewers() && !player->moveViewer({1, 0, 0}) && !player->viewer());
    QVERIFY(!player->handleKey(Qt::Key_Left) && !player->handleKey(Qt::Key_Home));
  }

  void brightnessIsAskedFor() {
    auto player = playerOf(still());
    player->start();
    QTRY_COMPARE(renderer_->brightness.load(), 1.0);
    player->setBrightness(0.5);
    QTRY_COMPARE(renderer_->brightness.load(), 0.5);
    QCOMPARE(player->brightness(), 0.5);
  }

  void aStillPictureIsRenderedOnceAndShown() {
    auto player = playerOf(still());
    player->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QSignalSpy shown(player.get(), &Player::shown);
    for (int turns = 0; turns < 200; ++turns) QCoreApplication::processEvents();
    QCOMPARE(renderer_->rendered.load(), 1);
    QCOMPARE(shown.count(), 0);
    QCOMPARE(player->statistics().frames, std::uint64_t{1});
    QCOMPARE(player->statistics().clipped, 0.25);
    // It stands: once more, with all the time that it takes, and no more.
    QVERIFY(!renderer_->thorough);
    hand_.now += 1s;
    QTRY_VERIFY(renderer_->thorough);
    hand_.now += 1h;
    for (int turns = 0; turns < 200; ++turns) QCoreApplication::processEvents();
    QCOMPARE(renderer_->rendered.load(), 2);
  }

  /// Brightness that is still on its way: rendered on and on until it has arrived, and then as one that
  /// stands.
  void aPictureIsRenderedUntilItSettles() {
    auto player = playerOf(still());
    renderer_->restless = true;
    player->start();
    QTRY_VERIFY(renderer_->rendered >= 10);
    QVERIFY(!renderer_->thorough);
    renderer_->restless = false;
    hand_.now += 1s;
    QTRY_VERIFY(renderer_->thorough);
    int rendered = renderer_->rendered;
    for (int turns = 0; turns < 200; ++turns) QCoreApplication::processEvents();
    QCOMPARE(renderer_->rendered.load(), rendered);
  }

  void filmFollowsTheClock() {
    auto player = playerOf(std::make_shared<Film>());
    player->start();
    for (auto time : {0s, 1s, 2s, 7s, 20s}) {
      hand_.now = std::chrono::steady_clock::time_point(time);
      QTRY_COMPARE(seen(), Film::greyAt(time).rgb());
    }
  }

  /// However long it takes to render one that stands, the next picture and the operator do not wait.
  void aPictureThatStandsGivesWay() {
    auto player = playerOf(std::make_shared<Film>(10s));
    renderer_->endless = true;
    player->start();
    QTRY_COMPARE(seen(), Film::greyAt(0s).rgb());
    hand_.now += 1s;
    QTRY_VERIFY(renderer_->thorough);
    hand_.now += 10s;
    QTRY_COMPARE(seen(), Film::greyAt(10s).rgb());
    hand_.now += 1s;
    QTRY_VERIFY(renderer_->thorough);
    player->setChart(allTestCharts.front());
    QImage chart = drawn(allTestCharts.front(), projectorSize).convertToFormat(QImage::Format_RGB32);
    QTRY_VERIFY(seenOn("DUMMY1") == chart);
    hand_.now += 1s;
    QTRY_VERIFY(renderer_->thorough);
    player->setContent(still());
    player->setChart(std::nullopt);
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    hand_.now += 1s;
    QTRY_VERIFY(renderer_->thorough);
    QImage plain = noise(projectorSize, 3);
    plain.invertPixels();
    QTest::keyClick(window_.get(), Qt::Key_C);
    QTRY_VERIFY(seenOn("DUMMY1") == plain);
  }

  /// However often it is computed, in the seconds after it came too.
  void aStillPictureHasNoFrameRate() {
    auto player = playerOf(still());
    renderer_->restless = true;
    player->start();
    QTRY_VERIFY(renderer_->rendered >= 10);
    QCOMPARE(player->statistics().framesPerSecond, 0.0);
    renderer_->restless = false;
    hand_.now += 5s;  // numbers of a film's pictures that no still has
    player->setContent(std::make_shared<Film>());
    // One picture in place of another is no film either.
    QTRY_COMPARE(seen(), Film::greyAt(5s).rgb());
    QCOMPARE(player->statistics().framesPerSecond, 0.0);
    for (auto time : {5100ms, 5200ms, 5300ms, 5400ms}) {
      hand_.now = std::chrono::steady_clock::time_point(time);
      QTRY_COMPARE(seen(), Film::greyAt(time).rgb());
    }
    QVERIFY(player->statistics().framesPerSecond > 0.0);
    player->setFrozen(true);
    QCOMPARE(player->statistics().framesPerSecond, 0.0);
    player->setFrozen(false);
    QVERIFY(player->statistics().framesPerSecond > 0.0);
    player->setContent(still());
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    hand_.now += 3s;
    QCOMPARE(player->statistics().framesPerSecond, 0.0);
  }

  void freezingHoldsPictureAndClock() {
    auto player = playerOf(std::make_shared<Film>());
    player->start();
    hand_.now += 3s;
    QTRY_COMPARE(seen(), Film::greyAt(3s).rgb());
    QTest::keyClick(window_.get(), Qt::Key_Space);
    QVERIFY(player->isFrozen());
    hand_.now += 10s;
    for (int turns = 0; turns < 200; ++turns) QCoreApplication::processEvents();
    QCOMPARE(seen(), Film::greyAt(3s).rgb());
    QTest::keyClick(window_.get(), Qt::Key_Space);
    hand_.now += 1s;
    QTRY_COMPARE(seen(), Film::greyAt(4s).rgb());
  }

  void blackIsBlackAndTheClockGoesOn() {
    auto player = playerOf(std::make_shared<Film>());
    player->start();
    hand_.now += 3s;
    QTRY_COMPARE(seen(), Film::greyAt(3s).rgb());
    QTest::keyClick(window_.get(), Qt::Key_B);
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
    hand_.now += 5s;
    QTest::keyClick(window_.get(), Qt::Key_B);
    QTRY_COMPARE(seen(), Film::greyAt(8s).rgb());
  }

  void compensationIsSwitchedOnAndOff() {
    auto player = playerOf(still());
    player->start();
    QImage compensated = noise(projectorSize, 3), plain = compensated;
    plain.invertPixels();
    QTRY_VERIFY(seenOn("DUMMY1") == compensated);
    QTest::keyClick(window_.get(), Qt::Key_C);
    QTRY_VERIFY(seenOn("DUMMY1") == plain);
    QTest::keyClick(window_.get(), Qt::Key_C);
    QTRY_VERIFY(seenOn("DUMMY1") == compensated);
  }

  void overlayStandsOnThePictureAndGoes() {
    auto player = playerOf(still());
    player->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    QTest::keyClick(window_.get(), Qt::Key_O);
    QTRY_VERIFY(seenOn("DUMMY1").copy(0, 0, 200, 20) != noise(projectorSize, 3).copy(0, 0, 200, 20));
    QVERIFY(seenOn("DUMMY1").copy(0, 400, 1024, 300) == noise(projectorSize, 3).copy(0, 400, 1024, 300));
    QTest::keyClick(window_.get(), Qt::Key_O);
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
  }

  void testChartsReplaceTheContentAndGo() {
    auto player = playerOf(std::make_shared<Film>());
    player->start();
    hand_.now += 3s;
    QTRY_COMPARE(seen(), Film::greyAt(3s).rgb());
    for (TestChart chart : allTestCharts) {
      QTest::keyClick(window_.get(), Qt::Key_T);
      QVERIFY(player->chart() == chart);
      QImage drive = drawn(chart, projectorSize).convertToFormat(QImage::Format_RGB32);
      QTRY_VERIFY(seenOn("DUMMY1") == drive);
    }
    hand_.now += 4s;
    QTest::keyClick(window_.get(), Qt::Key_T);
    QVERIFY(!player->chart());
    QTRY_COMPARE(seen(), Film::greyAt(7s).rgb());
  }

  /// On a picture that stands, too: how many are late is no matter of the moment in which it was switched on.
  void overlayIsRenewed() {
    auto player = playerOf(still());
    player->start();
    QTRY_VERIFY(seenOn("DUMMY1") == noise(projectorSize, 3));
    player->setOverlay(true);
    QSignalSpy shown(player.get(), &Player::shown);
    QTRY_VERIFY(shown.count() >= 2);
  }

  void survivesItsDisplayComingAndGoing() {
    auto player = playerOf(std::make_shared<Film>());
    QSignalSpy failed(player.get(), &Player::failed);
    player->start();
    for (int cycle = 1; cycle <= unplugCycles(10); ++cycle) {
      unplug();
      hand_.now += 1s;
      plug();
      QTRY_COMPARE(seen(), Film::greyAt(1s * cycle).rgb());
    }
    QCOMPARE(failed.count(), 0);
    QVERIFY(player->isPlaying());
  }

  void failureIsBlackAndSaid() {
    auto player = playerOf(std::make_shared<Film>());
    QSignalSpy failed(player.get(), &Player::failed);
    player->start();
    hand_.now += 3s;
    QTRY_COMPARE(seen(), Film::greyAt(3s).rgb());
    renderer_->broken = true;
    hand_.now += 1s;
    QTRY_COMPARE(failed.count(), 1);
    QVERIFY(english(failed[0][0].value<Message>()).find("the graphics card is gone") != std::string::npos);
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
    QVERIFY(!player->isPlaying());
  }

  void stoppingIsBlackAndItStartsAgain() {
    auto player = playerOf(std::make_shared<Film>());
    player->start();
    hand_.now += 3s;
    QTRY_COMPARE(seen(), Film::greyAt(3s).rgb());
    player->stop();
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
    hand_.now += 9s;
    player->start();
    QTRY_COMPARE(seen(), Film::greyAt(3s).rgb());
  }
};

QTEST_MAIN(TestPlayer)
#include "test_player.moc"
