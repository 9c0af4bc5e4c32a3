// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/base/error.h"
#include "relucent/devices/screen_rig.h"
#include "relucent/devices/whole_frames.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::image;
using namespace relucent::rig;

namespace {

/// A screen that loses its picture whenever the script says so, and the camera before it.
struct Script {
  std::vector<bool> lost;  // during the photograph of that number
  std::size_t photographs = 0;
  bool stands = true;
  bool rests = false;
  std::vector<float> shown;
  std::vector<std::string> events;
  double waited = 0.0;
  double exposure = 0.0;
};

class ScriptedScreen : public ScreenProjector {
 public:
  explicit ScriptedScreen(Script& script) : script_(script) {}
  std::string name() const override { return "HDMI-1"; }
  Size size() const override { return {2, 2}; }
  int bits() const override { return 8; }
  void show(const Image& picture) override {
    script_.shown.push_back(picture.at(0, 0, 0));
    script_.stands = true;
    script_.events.push_back("show");
  }
  bool stayedVisible() override { return script_.stands; }
  void rest() override { script_.rests = true, script_.stands = false; }

 private:
  Script& script_;
};

class ScriptedEye : public Camera {
 public:
  explicit ScriptedEye(Script& script, ExposureRange range = {1e-3, 2.0}) : script_(script), range_(range) {}
  std::string name() const override { return "eye"; }
  Size size() const override { return {1, 1}; }
  ExposureRange exposures() const override { return range_; }
  RawFrame capture(const CaptureRequest& request) override {
    const std::size_t number = script_.photographs++;
    script_.events.push_back("photograph");
    script_.exposure = request.seconds;
    if (number < script_.lost.size() && script_.lost[number]) script_.stands = false;
    return {Image({1, 1}, 3, script_.stands && !script_.shown.empty() ? script_.shown.back() : 0.0f), 0,
            request.seconds};
  }

 private:
  Script& script_;
  ExposureRange range_;
};

ScreenRig rigOf(Script& script, double latency = 0.0) {
  return screenRig(std::make_unique<ScriptedScreen>(script), std::make_unique<ScriptedEye>(script),
                   {latency, 0.01}, [&script](double seconds) { script.waited += seconds; });
}

}  // namespace

class TestScreenRig : public QObject {
  Q_OBJECT

 private slots:
  void aPhotographWithoutItsPictureIsTakenAgain() {
    Script script;
    script.lost = {false, true, true, false, true};
    ScreenRig screen = rigOf(script);
    for (float level : {0.25f, 0.5f, 0.75f}) {
      screen.rig.projectors[0]->show(Image({2, 2}, 3, level));
      QCOMPARE(screen.rig.cameras[0]->capture({}).signal.at(0, 0, 0), level);
    }
    // Three that were asked for, three that were lost, each after its picture was shown again.
    QCOMPARE(script.photographs, std::size_t{6});
    QCOMPARE(script.shown, (std::vector<float>{0.25f, 0.5f, 0.5f, 0.5f, 0.75f, 0.75f}));
  }

  void aScreenThatWasLeftToOthersShowsItsPictureFirst() {
    Script script;
    ScreenRig screen = rigOf(script);
    screen.rig.projectors[0]->show(Image({2, 2}, 3, 0.5f));
    screen.control->rest();
    QVERIFY(script.rests);
    QCOMPARE(screen.rig.cameras[0]->capture({}).signal.at(0, 0, 0), 0.5f);
    QCOMPARE(script.events, (std::vector<std::string>{"show", "show", "photograph"}));
  }

  /// Law: of several screens, each of them must keep its picture; only the one that lost it shows it again.
  void everyScreenMustKeepItsPicture() {
    Script first, second;
    second.lost = {true};
    std::vector<std::unique_ptr<ScreenProjector>> screens;
    screens.push_back(std::make_unique<ScriptedScreen>(first));
    screens.push_back(std::make_unique<ScriptedScreen>(second));
    std::vector<std::unique_ptr<Camera>> cameras;
    cameras.push_back(std::make_unique<ScriptedEye>(second));
    cameras.push_back(std::make_unique<ScriptedEye>(first));
    ScreenRig rig = screenRig(std::move(screens), std::move(cameras), {0.0, 0.01}, [](double) {});
    QCOMPARE(rig.rig.projectorRasters().devices(), std::size_t{2});
    rig.rig.projectors[0]->show(Image({2, 2}, 3, 0.25f));
    rig.rig.projectors[1]->show(Image({2, 2}, 3, 0.75f));
    QCOMPARE(rig.rig.cameras[0]->capture({}).signal.at(0, 0, 0), 0.75f);
    QCOMPARE(second.photographs, std::size_t{2});
    QCOMPARE(first.shown, (std::vector<float>{0.25f}));
    QCOMPARE(second.shown, (std::vector<float>{0.75f, 0.75f}));
    // The other camera looks after the same screens.
    second.stands = false;
    QCOMPARE(rig.rig.cameras[1]->capture({}).signal.at(0, 0, 0), 0.25f);
    QCOMPARE(second.shown.size(), std::size_t{3});
    rig.control->rest();
    QVERIFY(first.rests && second.rests);
  }

  void aPictureThatIsLostForEverIsToldOf() {
    Script script;
    script.lost.assign(1000, true);
    ScreenRig screen = rigOf(script);
    screen.rig.projectors[0]->show(Image({2, 2}, 3, 0.5f));
    QVERIFY(mentions(sentenceOf([&] { screen.rig.cameras[0]->capture({}); }, ErrorKind::device),
                     "HDMI-1: the projector's screen keeps losing its picture"));
  }

  void theLatencyIsWaitedForAndMayChange() {
    Script script;
    ScreenRig screen = rigOf(script, 0.05);
    screen.rig.projectors[0]->show(Image({2, 2}, 3, 0.5f));
    QCOMPARE(script.waited, 0.05);
    screen.control->setLatency(0.2);
    screen.rig.projectors[0]->show(Image({2, 2}, 3, 0.5f));
    QCOMPARE(script.waited, 0.05 + 0.2);
  }

  void exposuresBecomeWholeFrames_data() {
    QTest::addColumn<double>("asked");
    QTest::addColumn<double>("frames");
    QTest::newRow("none") << 0.0 << 1.0;
    QTest::newRow("less than one") << 0.3 << 1.0;
    QTest::newRow("one") << 1.0 << 1.0;
    QTest::newRow("down") << 2.4 << 2.0;
    QTest::newRow("up") << 2.6 << 3.0;
    QTest::newRow("too many") << 500.0 << 20.0;
  }
  void exposuresBecomeWholeFrames() {
    QFETCH(double, asked);
    QFETCH(double, frames);
    constexpr double frame = 1.0 / 59.94;
    Script script;
    auto camera =
        inWholeFrames(std::make_unique<ScriptedEye>(script, ExposureRange{0.7 * frame, 20.3 * frame}), frame);
    QCOMPARE(camera->exposures().shortest, frame);
    QCOMPARE(camera->exposures().longest, 20.0 * frame);
    QCOMPARE(camera->capture({{"a", 1}, 0, asked * frame}).seconds, frames * frame);
    QCOMPARE(script.exposure, frames * frame);
  }

  void aScreensExposuresAreWholeFramesUnlessItIsJudged() {
    Script script;
    ScreenRig screen = rigOf(script);
    Camera& camera = *screen.rig.cameras[0];
    QCOMPARE(camera.exposures().shortest, 0.01);
    QCOMPARE(camera.capture({{"a", 1}, 0, 0.034}).seconds, 0.03);
    screen.control->setWholeFrames(false);
    QCOMPARE(camera.exposures().shortest, 1e-3);
    QCOMPARE(camera.capture({{"a", 1}, 0, 0.034}).seconds, 0.034);
  }

  void aCameraThatCannotKeepsItsExposures() {
    Script script;
    auto camera = inWholeFrames(std::make_unique<ScriptedEye>(script, ExposureRange{1e-3, 1e-2}), 1.0 / 60.0);
    QCOMPARE(camera->exposures().longest, 1e-2);
    QCOMPARE(camera->capture({{"a", 1}, 0, 5e-3}).seconds, 5e-3);
  }
};

QTEST_GUILESS_MAIN(TestScreenRig)
#include "test_screen_rig.moc"
