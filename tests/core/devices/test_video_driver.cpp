// SPDX-License-Identifier: MIT
// Webcams, against a scripted one: pictures come all the time, some wait in a queue, and it has its own ideas
// about exposure. Its clock moves only when a picture is waited for.
#include <QtTest>
#include <algorithm>
#include <deque>
#include <map>

#include "relucent/base/error.h"
#include "relucent/devices/driven_camera.h"
#include "relucent/devices/video/video_driver.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::rig;
using namespace std::chrono_literals;
using std::chrono::microseconds;

namespace {

struct Script {
  bool isPlugged = true, isBusy = false, isSilent = false;
  std::map<VideoControl, double> controls{{VideoControl::exposureMode, 3.0},
                                          {VideoControl::exposure, 156.0},
                                          {VideoControl::automaticWhiteBalance, 1.0},
                                          {VideoControl::automaticFocus, 1.0},
                                          {VideoControl::gain, 12.0}};
  std::vector<VideoControl> stubborn{};  // set() says yes and nothing happens
  double leastExposure = 3.0, mostExposure = 2047.0;
  Size size{8, 6};
  enum class Stamps { good, none, otherClock } stamps = Stamps::good;
  int framesUntilExposureActs = 2;
  microseconds clock = 1000s;
  microseconds period = 33ms;

  struct Frame {
    microseconds stamp{};
    int value = 0;
  };
  std::deque<Frame> queue{};
  microseconds lastFrame = 1000s;
  std::vector<std::pair<microseconds, int>> scenes{{0us, 0}};  // what is there from when on
  std::deque<double> acting{};                                 // exposures that act on the next frames
  int opened = 0;

  void show(int value) { scenes.emplace_back(clock, value); }
  int sceneAt(microseconds time) const {
    int value = 0;
    for (const auto& [from, what] : scenes)
      if (from <= time) value = what;
    return value;
  }
  void miss() { lastFrame += period; }
  void capture() {
    lastFrame += period;
    double exposure = controls.at(VideoControl::exposure);
    acting.push_back(exposure);
    if (static_cast<int>(acting.size()) > framesUntilExposureActs) {
      exposure = acting.front();
      acting.pop_front();
    }
    // One unit of value a unit of exposure on top of the scene, to see which exposure acted.
    const microseconds begun = lastFrame - microseconds(static_cast<std::int64_t>(exposure * 100.0));
    queue.push_back({lastFrame, sceneAt(begun) + (exposure > 100.0 ? 100 : 0)});
  }
};

class ScriptedVideo : public VideoSource {
 public:
  explicit ScriptedVideo(std::shared_ptr<Script> script) : script_(std::move(script)) {}

  bool exists() const override { return script_->isPlugged; }
  bool open(std::optional<Size>) override {
    if (!script_->isPlugged || script_->isBusy) return false;
    ++script_->opened;
    script_->queue.clear();
    script_->lastFrame = script_->clock;
    return true;
  }
  void close() noexcept override {}
  bool set(VideoControl control, double value) override {
    auto place = script_->controls.find(control);
    if (place == script_->controls.end()) return false;
    const auto& stubborn = script_->stubborn;
    if (std::find(stubborn.begin(), stubborn.end(), control) != stubborn.end()) return true;
    place->second = control == VideoControl::exposure
                        ? std::clamp(value, script_->leastExposure, script_->mostExposure)
                        : value;
    return true;
  }
  std::optional<double> get(VideoControl control) override {
    auto place = script_->controls.find(control);
    if (!script_->isPlugged || place == script_->controls.end()) return std::nullopt;
    return place->second;
  }
  std::optional<VideoFrame> grab() override {
    if (!script_->isPlugged || script_->isSilent) return std::nullopt;
    // The oldest pictures stay in a full queue, newer ones are thrown away.
    while (script_->lastFrame + script_->period <= script_->clock)
      script_->queue.size() < 4 ? script_->capture() : script_->miss();
    if (script_->queue.empty()) {
      script_->capture();
      script_->clock = std::max(script_->clock, script_->lastFrame);
    }
    script_->clock += 2ms;  // decoding
    const Script::Frame next = script_->queue.front();
    script_->queue.pop_front();
    VideoFrame frame{script_->size, {}, next.stamp};
    if (script_->stamps == Script::Stamps::none) frame.captured.reset();
    if (script_->stamps == Script::Stamps::otherClock) *frame.captured += 500'000s;
    frame.bgr.assign(3 * script_->size.count(), static_cast<std::uint8_t>(next.value));
    return frame;
  }
  microseconds now() const override { return script_->clock; }
  void wait(microseconds time) override { script_->clock += time; }

 private:
  std::shared_ptr<Script> script_;
};

struct Webcam {
  std::shared_ptr<Script> script = std::make_shared<Script>();
  std::unique_ptr<DrivenCamera> camera{};

  void open(std::optional<Size> size = std::nullopt) {
    camera = std::make_unique<DrivenCamera>(
        makeVideoDriver(std::make_unique<ScriptedVideo>(script), "v4l2:/dev/video7", size), videoPatience());
  }
  /// The code of a photograph of a scene that is shown from now on.
  int photograph(int scene, double seconds) {
    script->show(scene);
    const RawFrame frame = camera->capture({{"test", scene}, 0, seconds});
    return static_cast<int>(std::lround(frame.signal.at(0, 0, 0) * 255.0f));
  }
};

}  // namespace

class TestVideoDriver : public QObject {
  Q_OBJECT

 private slots:
  void everythingAutomaticIsOffAndTheRangeIsTheDevicesOwn() {
    Webcam webcam;
    webcam.open();
    QCOMPARE(webcam.script->controls[VideoControl::exposureMode], 1.0);
    QCOMPARE(webcam.script->controls[VideoControl::automaticWhiteBalance], 0.0);
    QCOMPARE(webcam.script->controls[VideoControl::automaticFocus], 0.0);
    QCOMPARE(webcam.camera->size(), (Size{8, 6}));
    QVERIFY(std::abs(webcam.camera->exposures().shortest - 0.0003) < 1e-12);
    QVERIFY(std::abs(webcam.camera->exposures().longest - 0.2047) < 1e-12);
    QCOMPARE(webcam.camera->traits().gain, 12.0);
  }

  void exposuresAreWhatIsReadBack() {
    Webcam webcam;
    webcam.open();
    const RawFrame frame = webcam.camera->capture({{"test", 1}, 0, 0.01234});
    QVERIFY(std::abs(frame.seconds - 0.0123) < 1e-12);
    QCOMPARE(frame.bits, 8);
    webcam.script->stubborn = {VideoControl::exposure};
    const std::string sentence =
        sentenceOf([&] { webcam.camera->capture({{"test", 1}, 0, 0.1}); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "was asked to expose 0.1 s but exposes 0.0123 s"));
  }

  void onlyPicturesBegunAfterwardsCount_data() {
    QTest::addColumn<int>("stamps");
    QTest::newRow("by their stamps") << static_cast<int>(Script::Stamps::good);
    QTest::newRow("without stamps") << static_cast<int>(Script::Stamps::none);
    QTest::newRow("stamps of another clock") << static_cast<int>(Script::Stamps::otherClock);
  }
  void onlyPicturesBegunAfterwardsCount() {
    QFETCH(int, stamps);
    Webcam webcam;
    webcam.script->stamps = static_cast<Script::Stamps>(stamps);
    webcam.open();
    for (int scene = 1; scene < 20; ++scene) {
      QCOMPARE(webcam.photograph(scene, 0.005), scene);
      webcam.script->clock += (scene % 5) * 40ms;  // the venue thinks, and the queue fills
    }
    const auto& remarks = webcam.camera->traits().remarks;
    QCOMPARE(remarks.size(), std::size_t{stamps == static_cast<int>(Script::Stamps::good) ? 1u : 2u});
  }

  void picturesWithTheOldExposureAreSkipped() {
    Webcam webcam;
    webcam.open();
    for (int round = 0; round < 3; ++round) {
      QCOMPARE(webcam.photograph(1, 0.005), 1);
      QCOMPARE(webcam.photograph(2, 0.02), 102);  // over 100 units: the longer exposure acted
    }
  }

  void whatCannotBeUsedIsRefused_data() {
    QTest::addColumn<QString>("fault");
    QTest::addColumn<QString>("part");
    QTest::newRow("exposure")
        << "exposure"
        << "v4l2:/dev/video7: the video device's automatic exposure cannot be switched off";
    QTest::newRow("white balance") << "white balance"
                                   << "automatic white balance cannot be switched off";
    QTest::newRow("focus") << "focus"
                           << "automatic focus cannot be switched off";
    QTest::newRow("no exposure") << "no exposure"
                                 << "has no exposure that can be set; use a camera with manual";
    QTest::newRow("fixed exposure") << "fixed exposure"
                                    << "whatever exposure it is asked for";
    QTest::newRow("busy") << "busy"
                          << "cannot be opened: another program may be using it";
    QTest::newRow("missing") << "missing"
                             << "no such video device is plugged in";
    QTest::newRow("silent") << "silent"
                            << "sends no pictures";
    QTest::newRow("size") << "size"
                          << "64x48 pixels are wanted and the video device gives 8x6";
  }
  void whatCannotBeUsedIsRefused() {
    QFETCH(QString, fault);
    QFETCH(QString, part);
    Webcam webcam;
    Script& script = *webcam.script;
    std::optional<Size> size;
    if (fault == "exposure") script.stubborn = {VideoControl::exposureMode};
    if (fault == "white balance") script.stubborn = {VideoControl::automaticWhiteBalance};
    if (fault == "focus") script.stubborn = {VideoControl::automaticFocus};
    if (fault == "no exposure") script.controls.erase(VideoControl::exposure);
    if (fault == "fixed exposure") script.stubborn = {VideoControl::exposure};
    if (fault == "busy") script.isBusy = true;
    if (fault == "missing") script.isPlugged = false;
    if (fault == "silent") script.isSilent = true;
    if (fault == "size") size = Size{64, 48};
    QVERIFY(mentions(sentenceOf([&] { webcam.open(size); }, ErrorKind::device), part.toStdString()));
  }

  void aDeviceWithFewControlsWillDo() {
    Webcam webcam;
    webcam.script->controls = {{VideoControl::exposure, 20.0}};
    webcam.open();
    QCOMPARE(webcam.photograph(7, 0.005), 7);
  }

  void aFrameOfAnotherSizeLeadsToANewStart() {
    Webcam webcam;
    webcam.open();
    webcam.script->size = {4, 4};
    const std::string sentence = sentenceOf([&] { webcam.photograph(1, 0.005); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "came back with 4x4 pixels instead of 8x6"));
  }

  void aDeviceThatFallsSilentIsTold() {
    Webcam webcam;
    webcam.open();
    webcam.script->isSilent = true;
    const std::string sentence = sentenceOf([&] { webcam.photograph(1, 0.005); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "the camera has been gone for 3"));
    webcam.script->isSilent = false;
    QCOMPARE(webcam.photograph(2, 0.005), 2);
  }

  void aDeviceThatVanishesIsToldAndComesBack() {
    Webcam webcam;
    webcam.open();
    QCOMPARE(webcam.photograph(1, 0.005), 1);
    webcam.script->isPlugged = false;
    const std::string sentence = sentenceOf([&] { webcam.photograph(2, 0.005); }, ErrorKind::device);
    QVERIFY(mentions(sentence, "gone for 30 s: no such video device is plugged in"));
    webcam.script->isPlugged = true;
    QCOMPARE(webcam.photograph(3, 0.005), 3);
    QCOMPARE(webcam.camera->reconnections(), 1);
  }

  void aPathWithoutADeviceIsTold() {
    // The real thing, as far as it goes on a machine without a camera.
    auto source = openCvVideoSource("/dev/no-such-video");
    QVERIFY(!source->exists());
    QVERIFY(!source->open(std::nullopt));
    QVERIFY(!source->grab());
    auto noCamera = openCvVideoSource("/dev/null");
    QVERIFY(noCamera->exists());
    QVERIFY(!noCamera->open(std::nullopt));
  }
};

QTEST_GUILESS_MAIN(TestVideoDriver)
#include "test_video_driver.moc"
