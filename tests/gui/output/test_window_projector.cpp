// SPDX-License-Identifier: MIT
// Runs on two screens that can be unplugged, see tests/support/with-two-screens.
#include "output/window_projector.h"

#include <QRasterWindow>
#include <QThread>
#include <QtTest>
#include <atomic>

#include "desktop/display_power.h"
#include "gui/output/two_screens.h"
#include "relucent/base/error.h"
#include "support/screen_light.h"
#include "support/waited.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::rig;
using test::ScreenLight;

namespace {

constexpr Size size{1024, 768};

Image noiseOf(quint32 seed) {
  Image image(size, 3);
  QRandomGenerator random(seed);
  for (float& value : image.data()) value = static_cast<float>(random.bounded(256)) / 255.0f;
  return image;
}

/// Something happens during its first photograph.
class DisturbedCamera : public Camera {
 public:
  explicit DisturbedCamera(std::function<void()> disturb) : disturb_(std::move(disturb)) {}
  std::string name() const override { return "disturbed camera"; }
  Size size() const override { return {2, 2}; }
  ExposureRange exposures() const override { return {0.001, 1.0}; }
  RawFrame capture(const CaptureRequest& request) override {
    if (photographs_++ == 0) disturb_();
    return {Image(size(), 3, static_cast<float>(photographs_)), 0, request.seconds};
  }

 private:
  std::function<void()> disturb_;
  int photographs_ = 0;
};

}  // namespace

class TestWindowProjector : public QObject {
  Q_OBJECT

  /// Runs `work` on another thread while this one is the interface.
  static std::string onWorker(const std::function<void()>& work,
                              const std::function<void(QThread&)>& meanwhile = {}) {
    std::string thrown;
    std::unique_ptr<QThread> worker(QThread::create([&] {
      try {
        work();
      } catch (const Cancelled&) {
        thrown = "cancelled";
      } catch (const std::exception& error) {
        thrown = error.what();
      }
    }));
    worker->start();
    if (meanwhile) meanwhile(*worker);
    waitFor(*worker);
    return thrown;
  }
  static WindowProjector made(std::function<void(bool)> waiting = {}, Size pixels = size) {
    return WindowProjector(identityOf(displayOf(*screenOn("DUMMY1"))), pixels, std::move(waiting));
  }
  static std::unique_ptr<WindowProjector> waking(std::chrono::milliseconds time) {
    return std::make_unique<WindowProjector>(identityOf(displayOf(*screenOn("DUMMY1"))), size,
                                             std::function<void(bool)>(), time);
  }

 private slots:
  void cleanup() {
    if (screenOn("DUMMY1") == nullptr) plug();
    xset({"s", "reset"});
  }

  /// show() returns when the light is out: whoever looks then sees this picture and nothing older.
  void everyPixelIsOutWhenShowReturns() {
    WindowProjector projector = made();
    ScreenLight light("DUMMY1");
    int right = 0;
    const std::string thrown = onWorker([&] {
      for (quint32 seed = 1; seed <= 10; ++seed) {
        const Image picture = noiseOf(seed);
        projector.show(picture);
        right += light.look(size).data() == picture.data();
        right += projector.stayedVisible();
      }
    });
    QCOMPARE(thrown, std::string());
    QCOMPARE(right, 20);
  }

  /// The wizard keeps them while it measures, also when the projector's window comes back.
  void itNeverTakesTheKeys() {
    QRasterWindow wizard;
    wizard.setGeometry(screenOn("DUMMY0")->geometry());
    wizard.show();
    wizard.requestActivate();
    QVERIFY(QTest::qWaitForWindowActive(&wizard));
    QSignalSpy taken(qGuiApp, &QGuiApplication::focusWindowChanged);
    WindowProjector projector = made();
    bool keeps = true;
    QCOMPARE(onWorker([&] {
               for (quint32 seed = 1; seed <= 3; ++seed) {
                 projector.show(noiseOf(seed));
                 keeps = keeps && projector.stayedVisible();
                 projector.rest();
               }
             }),
             std::string());
    QVERIFY(keeps);
    QCOMPARE(taken.size(), 0);
    QCOMPARE(QGuiApplication::focusWindow(), &wizard);
  }

  void anUnpluggedScreenIsWaitedForAndNothingIsLost() {
    std::atomic<bool> waits = false;
    WindowProjector projector = made([&waits](bool missing) { waits = missing; });
    ScreenLight light("DUMMY1");
    const Image first = noiseOf(1), second = noiseOf(2);
    bool stoodBefore = false, stoodAfter = true, rightAgain = false;
    QCOMPARE(onWorker([&] {
               projector.show(first);
               stoodBefore = projector.stayedVisible();
             }),
             std::string());
    unplug();
    QTRY_VERIFY(waits);
    const std::string thrown = onWorker(
        [&] {
          stoodAfter = projector.stayedVisible();
          projector.show(second);
          rightAgain = light.look(size).data() == second.data() && projector.stayedVisible();
        },
        [&](QThread& worker) {
          QVERIFY(!worker.wait(100));  // it waits, and this thread goes on
          plug();
        });
    QCOMPARE(thrown, std::string());
    QVERIFY(stoodBefore && !stoodAfter && rightAgain && !waits);
  }

  /// Law: a projector that goes is waited for by nobody, though its screen is still away.
  void itWaitsNoMoreWhenItGoes() {
    std::atomic<bool> waits = false;
    {
      WindowProjector projector = made([&waits](bool missing) { waits = missing; });
      QCOMPARE(onWorker([&] { projector.show(noiseOf(1)); }), std::string());
      unplug();
      QTRY_VERIFY(waits);
    }
    QVERIFY(!waits);
  }

  void displaysThatSleepAreWokenAndGivenTheirTime_data() { addWaysToSleep(); }
  void displaysThatSleepAreWokenAndGivenTheirTime() {
    QFETCH(QStringList, sleep);
    if (QString why = whyNoSleep(sleep); !why.isEmpty()) QSKIP(qPrintable(why));
    const auto projector = waking(std::chrono::milliseconds(300));
    const DisplayPower power;
    std::vector<qint64> dark;  // milliseconds
    bool stood = true, awake = true;
    auto showAfterSleep = [&](bool shownBefore) {
      xset(sleep);
      QElapsedTimer timer;
      timer.start();
      if (shownBefore) stood = projector->stayedVisible();
      projector->show(noiseOf(6));
      dark.push_back(timer.elapsed());
      awake = awake && power.state() == DisplayPower::State::awake && projector->stayedVisible();
    };
    QCOMPARE(onWorker([&] {
               showAfterSleep(false);
               showAfterSleep(true);
             }),
             std::string());
    QVERIFY(awake && !stood);
    for (qint64 milliseconds : dark) QVERIFY2(milliseconds >= 300, qPrintable(QString::number(milliseconds)));
  }

  void aPhotographDuringWhichTheDisplaySleptIsTakenAgain_data() { addWaysToSleep(); }
  void aPhotographDuringWhichTheDisplaySleptIsTakenAgain() {
    QFETCH(QStringList, sleep);
    QFETCH(QStringList, wake);
    if (QString why = whyNoSleep(sleep); !why.isEmpty()) QSKIP(qPrintable(why));
    ScreenLight light("DUMMY1");
    for (const bool wokenMeanwhile : {false, true}) {
      ScreenRig devices =
          screenRig(waking(std::chrono::milliseconds(1)), std::make_unique<DisturbedCamera>([&] {
                      xset(sleep);
                      if (wokenMeanwhile) xset(wake);
                    }),
                    {}, sleepFor);
      const Image picture = noiseOf(7);
      float taken = 0.0f;
      bool isOut = false;
      const std::string thrown = onWorker([&] {
        devices.rig.projectors[0]->show(picture);
        taken = devices.rig.cameras[0]->capture({{"asleep", 0}, 0, 0.01}).signal.at(0, 0, 0);
        isOut = light.look(size).data() == picture.data();
      });
      QCOMPARE(thrown, std::string());
      QCOMPARE(taken, 2.0f);  // not the first
      QVERIFY(isOut && DisplayPower().state() == DisplayPower::State::awake);
    }
  }

  void displaysThatDoNotWakeAreTold() {
    const auto projector = waking(std::chrono::milliseconds(100));
    QProcess rival;
    rival.start("sh", {"-c", "while xset s activate; do :; done"});
    QVERIFY(rival.waitForStarted());
    const std::string thrown = onWorker([&] { projector->show(noiseOf(8)); });
    rival.kill();
    rival.waitForFinished();
    QVERIFY2(QString::fromStdString(thrown).contains("is asleep and does not wake"), thrown.c_str());
  }

  void whoWaitsForAScreenCanBeStopped() {
    WindowProjector projector = made();
    unplug();
    const std::string thrown = onWorker([&] { projector.show(noiseOf(3)); },
                                        [](QThread& worker) {
                                          worker.requestInterruption();
                                          // The interface may wait for the worker, as it does when it ends.
                                          QVERIFY(worker.wait(5000));
                                        });
    QCOMPARE(thrown, std::string("cancelled"));
  }

  void aScreenOfAnotherSizeIsRefused() {
    WindowProjector projector = made({}, {800, 600});
    const std::string thrown = onWorker([&] { projector.show(Image({800, 600}, 3, 1.0f)); });
    QVERIFY2(QString::fromStdString(thrown).contains("has 1024x768 pixels now and 800x600 were calibrated"),
             thrown.c_str());
  }

  void atRestTheScreenIsOthers() {
    WindowProjector projector = made();
    QCOMPARE(onWorker([&] { projector.show(noiseOf(4)); }), std::string());
    projector.rest();
    QTRY_VERIFY(allBlack(seenOn("DUMMY1")));
    QVERIFY(QGuiApplication::topLevelWindows().isEmpty() ||
            !QGuiApplication::topLevelWindows()[0]->isVisible());
    QCOMPARE(onWorker([&] { projector.show(noiseOf(5)); }), std::string());
    QTRY_VERIFY(!allBlack(seenOn("DUMMY1")));
  }
};

QTEST_MAIN(TestWindowProjector)
#include "test_window_projector.moc"
