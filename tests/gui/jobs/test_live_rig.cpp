// SPDX-License-Identifier: MIT
// What is seen of a rig of two projectors and two cameras while it measures.
#include "jobs/live_rig.h"

#include <QSemaphore>
#include <QSignalSpy>
#include <QThread>
#include <QtTest>
#include <atomic>
#include <memory>

#include "relucent/linearization/mosaic.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::rig;

namespace {

Image even(float red) {
  Image pattern({2, 2}, 3, 0.0f);
  for (std::size_t i = 0; i < pattern.pixels(); ++i) pattern.pixel(i)[0] = red;
  return pattern;
}

RawFrame lit(float signal) {
  return {Image({2, 2}, 3, signal), 12, 0.5};
}

}  // namespace

class TestLiveRig : public QObject {
  Q_OBJECT

 private slots:
  void eachDeviceHasItsOwnPicture() {
    LiveRig live(0);
    QVERIFY(live.pictures(1, 1).pattern.empty() && live.pictures(1, 1).frame.signal.empty());
    live.shown(0, even(0.0f));
    live.shown(1, even(0.7f));
    live.photographed(0, {{"stage", 3}, 0, 0.5}, lit(0.1f));
    live.photographed(1, {{"stage", 3}, 1, 0.5}, lit(0.2f));
    QCOMPARE(live.pictures().pattern, even(0.0f));
    QCOMPARE(live.pictures(1).pattern, even(0.7f));
    QCOMPARE(live.pictures(0, 1).frame.signal, lit(0.2f).signal);
    QCOMPARE(live.pictures(0, 1).request.exposure, 1);
    QCOMPARE(live.pictures(1, 0).frame.signal, lit(0.1f).signal);
    QCOMPARE(live.pictures(1, 1).photographs, 2);
  }

  /// Law: a camera is silent from some seconds beyond its exposure on; one that is always slow later than
  /// that, and one that has answered, or failed, not at all.
  void aPhotographThatDoesNotComeIsNoticedInSeconds() {
    using namespace std::chrono_literals;
    LiveRig live(0);
    const auto now = LiveRig::Clock::now();
    QVERIFY(!live.silentCamera(now + 1h));
    live.beforePhotographing(1, {{"stage", 3}, 0, 2.0});
    QVERIFY(!live.silentCamera(now + 5s));
    QCOMPARE(live.silentCamera(now + 7s), std::optional<std::size_t>(1));
    live.afterPhotographing(1);
    QVERIFY(!live.silentCamera(now + 1h));
    // The next one is noticed as soon: what failed says nothing of how slow it is.
    live.beforePhotographing(0, {{"stage", 4}, 0, 0.0});
    QCOMPARE(live.silentCamera(now + 5s), std::optional<std::size_t>(0));
    live.afterPhotographing(0);
    live.photographed(0, {}, lit(0.1f));
    QCOMPARE(live.photographs(), 1);
  }

  /// Law: whoever pauses does not wait for the light: a window goes dark on the thread that asks meanwhile.
  void nobodyWaitsForTheLight() {
    LiveRig live(0);
    struct Light : RigLight {
      LiveRig& live;
      int answers = 0;
      explicit Light(LiveRig& of) : live(of) {}
      void ask() {
        constexpr int patience = 10'000;  // ms, for a thread on a busy machine
        const std::unique_ptr<QThread> interface(QThread::create([this] { live.pictures(); }));
        interface->start();
        if (!interface->wait(QDeadlineTimer(patience))) qFatal("who asks waits for the light");
        ++answers;
      }
      void darken() override {
        ask();
        live.resume();
      }
      void restore() override { ask(); }
    } light(live);
    live.pause();
    live.beforeShowing(0, light);
    QCOMPARE(light.answers, 2);
    QVERIFY(live.paused() < std::chrono::hours(1));
  }

  /// Law: the time in which a photograph waits for another device is not the camera's.
  void whoWaitsForAScreenIsNotSilent() {
    using namespace std::chrono_literals;
    LiveRig::Clock::time_point time{};
    LiveRig live(0);
    live.setClock([&time] { return time; });
    live.beforePhotographing(0, {{"stage", 3}, 0, 1.0});
    time += 1h;
    QVERIFY(live.silentCamera().has_value());
    live.waitAnew();
    QVERIFY(!live.silentCamera() && !live.silentCamera(time + 3s));
    QVERIFY(live.silentCamera(time + 5s).has_value());
  }

  /// Law: slow cameras are waited for longer; one photograph that was held up makes none slow.
  void slowCamerasAreWaitedForLonger() {
    using namespace std::chrono_literals;
    LiveRig::Clock::time_point time{};
    const auto take = [&time](LiveRig& live, std::chrono::milliseconds lasts) {
      live.beforePhotographing(0, {{"stage", 3}, 0, 0.0});
      time += lasts;
      live.afterPhotographing(0);
      live.photographed(0, {{"stage", 3}, 0, 0.0}, lit(0.1f));
    };
    const auto isSilentAfter = [&time](LiveRig& live, std::chrono::milliseconds wait) {
      live.beforePhotographing(0, {{"stage", 4}, 0, 0.0});
      const bool silent = live.silentCamera(time + wait).has_value();
      live.afterPhotographing(0);
      return silent;
    };
    LiveRig slow(0), heldUp(0);
    for (LiveRig* live : {&slow, &heldUp}) live->setClock([&time] { return time; });
    for (int i = 0; i < 3; ++i) take(slow, 250ms);
    take(heldUp, 0ms);
    take(heldUp, 250ms);
    QVERIFY(!isSilentAfter(slow, 3400ms) && isSilentAfter(slow, 4500ms));
    QVERIFY(isSilentAfter(heldUp, 3400ms));
    QCOMPARE(slow.taken("stage").lastShot, 3);
    // Whoever looks through the camera meanwhile takes none of the stage's.
    const int taken = slow.taken("stage").photographs;
    QVERIFY(taken > 0 && slow.taken("nudge").photographs == 0 && slow.taken("nudge").lastShot < 0);
  }

  /// Law: what somebody pauses is told apart from work, also while the pause lasts.
  void pausesAreCounted() {
    using namespace std::chrono_literals;
    std::atomic<LiveRig::Clock::duration> time{};
    LiveRig live(0);
    live.setClock([&time] { return LiveRig::Clock::time_point(time.load()); });
    struct Light : RigLight {
      QSemaphore dark;
      void darken() override { dark.release(); }
      void restore() override {}
    } light;
    time = 10s;
    QCOMPARE(live.paused(), LiveRig::Clock::duration{});
    live.pause();
    std::unique_ptr<QThread> measuring(QThread::create([&] { live.beforeShowing(0, light); }));
    measuring->start();
    light.dark.acquire();
    QTRY_VERIFY((time = 70s, live.paused() == 60s));
    live.resume();
    measuring->wait();
    time = 100s;
    QCOMPARE(live.paused(), LiveRig::Clock::duration(60s));
    live.beforeShowing(0, light);
    QCOMPARE(live.paused(), LiveRig::Clock::duration(60s));
  }

  void everyCamerasPhotographIsTold() {
    LiveRig live(0);
    QSignalSpy seen(&live, &LiveRig::seen);
    live.photographed(0, {}, lit(0.1f));
    live.photographed(1, {}, lit(0.1f));
    QCOMPARE(seen.size(), 2);
  }

  /// White is white on all that shine, and of use where it is not overexposed.
  void theLastFloodlightImageIsKept_data() {
    QTest::addColumn<float>("first");
    QTest::addColumn<float>("second");
    QTest::addColumn<float>("signal");
    QTest::addColumn<bool>("isKept");
    QTest::newRow("both") << 1.0f << 1.0f << 0.6f << true;
    QTest::newRow("one alone") << 1.0f << 0.0f << 0.5f << true;
    QTest::newRow("grey beside it") << 1.0f << 0.5f << 0.5f << false;
    QTest::newRow("dark") << 0.0f << 0.0f << 0.1f << false;
    QTest::newRow("overexposed") << 1.0f << 1.0f << 1.0f << false;
  }
  void theLastFloodlightImageIsKept() {
    QFETCH(float, first);
    QFETCH(float, second);
    QFETCH(float, signal);
    QFETCH(bool, isKept);
    auto grey = [](float drive) { return Image({2, 2}, 3, drive); };
    LiveRig live(0);
    QCOMPARE(live.floodlightNumber(), 0);
    live.shown(0, grey(1.0f));
    live.shown(1, grey(1.0f));
    live.photographed(0, {}, lit(0.4f));
    live.shown(0, grey(first));
    live.shown(1, grey(second));
    live.photographed(0, {}, lit(signal));
    QCOMPARE(live.floodlightNumber(), isKept ? 2 : 1);
    QCOMPARE(live.floodlight().signal, lit(isKept ? signal : 0.4f).signal);
    QVERIFY(live.floodlight(1).signal.empty());
  }

  /// Where every exposure is too bright for parts of it, as of lamps in the view, it is the least one.
  void ofOverexposedFloodlightsTheLeastIsKept() {
    LiveRig live(0);
    live.shown(0, Image({2, 2}, 3, 1.0f));
    int number = 0, kept = 0;
    for (int clipped : {3, 2, 4, 2, 1, 3}) {
      RawFrame frame = lit(0.5f);
      frame.signal = Image({2, 2}, 3, 0.5f);
      for (int i = 0; i < 3 * clipped; ++i) frame.signal.data()[static_cast<std::size_t>(i)] = 1.0f;
      live.photographed(0, {}, frame);
      ++number;
      if (number == 1 || number == 2 || number == 4 || number == 5) kept = number;
      QCOMPARE(live.floodlightNumber(), kept);
    }
  }

  /// Black belongs to both; a light that shines alone is its projector's; together they are told apart.
  void everyProjectorHasItsRamps() {
    constexpr Size size{12, 12};
    const linearization::Mosaic mosaic(size, Random{1}, true);
    LiveRig live(0);
    // A camera that sees the projectors' pixels side by side, the second one's half as bright at half drive.
    auto show = [&live](const Image& first, const Image& second) {
      live.shown(0, first);
      live.shown(1, second);
      RawFrame frame{Image({12, 24}, 3, 0.1f), 12, 0.5};
      for (std::size_t i = 0; i < first.data().size(); ++i) {
        frame.signal.data()[i] += 0.8f * first.data()[i] * first.data()[i];
        frame.signal.data()[first.data().size() + i] += 0.8f * second.data()[i];
      }
      live.photographed(0, {}, frame);
    };
    auto grey = [&mosaic](double drive) {
      linearization::MosaicDrive drives{};
      drives.fill(drive);
      return mosaic.pattern(drives);
    };
    const Image black(size, 3);
    show(black, black);
    for (std::size_t q = 0; q < linearization::mosaicLights; ++q) {
      linearization::MosaicDrive drive{};
      drive[q] = 1.0;
      show(mosaic.pattern(drive), black);
      show(black, mosaic.pattern(drive));
    }
    show(grey(0.5), black);
    show(black, grey(0.5));
    show(grey(0.25), grey(0.75));
    QVERIFY(std::abs(live.ramps(0)[0].at(0.5) - 0.25) < 1e-5);
    QVERIFY(std::abs(live.ramps(0)[0].at(0.25) - 0.0625) < 1e-5);
    QVERIFY(std::abs(live.ramps(1)[0].at(0.5) - 0.5) < 1e-5);
    QVERIFY(std::abs(live.ramps(1)[0].at(0.75) - 0.75) < 1e-5);
    QCOMPARE(live.ramps(0)[0].at(1.0), 1.0);
    QVERIFY(live.ramps(2)[0].empty());
    live.forgetRamps();
    QVERIFY(live.ramps(0)[0].empty() && live.ramps(1)[0].empty());
  }
};

QTEST_GUILESS_MAIN(TestLiveRig)
#include "test_live_rig.moc"
