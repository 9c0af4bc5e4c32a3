// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/devices/check/latency.h"
#include "support/sentences.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::image;
using namespace relucent::rig;

namespace {

constexpr double frame = 1.0 / 60.0;

/// A projector that starts its frames by its own clock and is some frames late, and a camera before it. Time
/// passes only when it is waited for or exposed.
struct Stage {
  int delay = 0;
  double flicker = 0.0;
  double noise = 0.0;
  bool isCovered = false;
  double clock = 3.0017;
  int photographs = 0;
  std::vector<std::pair<double, float>> pictures{{0.0, 0.0f}};  // from when on, what

  void show(float level) {
    // What is sent during a frame is out from the beginning of a later one.
    const double out = (std::floor(clock / frame) + 1.0 + delay) * frame;
    pictures.emplace_back(out, level);
  }
  /// Mean light from `begin` to `end`.
  double light(double begin, double end) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const double from = std::max(begin, pictures[i].first);
      const double to = i + 1 < pictures.size() ? std::min(end, pictures[i + 1].first) : end;
      sum += std::max(0.0, to - from) * static_cast<double>(pictures[i].second);
    }
    return sum / (end - begin);
  }
  Wait wait() {
    return [this](double seconds) { clock += seconds; };
  }
};

class StageProjector : public Projector {
 public:
  explicit StageProjector(Stage& stage) : stage_(stage) {}
  std::string name() const override { return "late projector"; }
  Size size() const override { return {4, 3}; }
  int bits() const override { return 8; }
  void show(const Image& picture) override { stage_.show(picture.at(0, 0, 0)); }

 private:
  Stage& stage_;
};

class StageCamera : public Camera {
 public:
  explicit StageCamera(Stage& stage) : stage_(stage) {}
  std::string name() const override { return "stage camera"; }
  Size size() const override { return {3, 2}; }
  ExposureRange exposures() const override { return {1e-4, 1.0}; }
  RawFrame capture(const CaptureRequest& request) override {
    Random random{5, static_cast<std::uint64_t>(++stage_.photographs)};
    double light = 0.05 + 0.7 * stage_.light(stage_.clock, stage_.clock + request.seconds);
    if (stage_.isCovered) light = 0.01;
    light *= 1.0 + stage_.flicker * random.normal();
    stage_.clock += request.seconds;
    RawFrame photograph{Image({3, 2}, 3), 0, request.seconds};
    for (float& value : photograph.signal.data())
      value = static_cast<float>(light + stage_.noise * random.normal());
    return photograph;
  }

 private:
  Stage& stage_;
};

Latency measured(Stage& stage, double exposure, LatencySettings settings = {}) {
  StageProjector projector(stage);
  StageCamera camera(stage);
  Progress silent;
  return measureLatency(projector, camera, exposure, settings, stage.wait(), silent);
}

}  // namespace

class TestLatency : public QObject {
  Q_OBJECT

 private slots:
  void aDelayPutInOnPurposeIsFound_data() {
    QTest::addColumn<int>("delay");
    QTest::addColumn<double>("exposure");
    QTest::addColumn<double>("noise");
    for (int delay = 0; delay <= 5; ++delay)
      for (double exposure : {0.002, frame, 2.5 * frame})
        for (double noise : {0.0, 0.01})
          QTest::addRow("%d frames, %.1f ms, noise %g", delay, 1000.0 * exposure, noise)
              << delay << exposure << noise;
  }
  void aDelayPutInOnPurposeIsFound() {
    QFETCH(int, delay);
    QFETCH(double, exposure);
    QFETCH(double, noise);
    Stage stage;
    stage.delay = delay;
    stage.noise = noise;
    const Latency latency = measured(stage, exposure);
    // A picture appears after `delay` to `delay` + 1 frames, as it happens to be sent late or early in one.
    QVERIFY(latency.frames == delay || latency.frames == delay + 1);
    QVERIFY(mentions(english(messageOf(latency.verdicts.front())),
                     "A picture takes " + std::to_string(std::lround(1e3 * latency.seconds)) + " ms"));

    // Whoever waits so long sees nothing older, whenever it begins.
    auto patient = delayed(std::make_unique<StageProjector>(stage), latency.seconds, stage.wait());
    StageCamera camera(stage);
    for (int i = 0; i < 100; ++i) {
      stage.clock += 0.0123;
      patient->show(Image({4, 3}, 3, static_cast<float>(i % 2)));
      QCOMPARE(stage.light(stage.clock, stage.clock + exposure), static_cast<double>(i % 2));
    }
  }

  /// Waits and exposures of whole frames would leave every step at the phase of the first: a picture sent at
  /// the end of a frame is out sooner than one sent at its beginning, and the least delay is that of the
  /// worst.
  void theWorstPhaseOfAFrameCounts_data() {
    QTest::addColumn<double>("phase");
    QTest::addColumn<double>("exposure");
    for (double phase : {0.01, 0.5, 0.9, 0.99})
      for (double frames : {1.0, 3.0})
        QTest::addRow("%.2f, %.0f frames", phase, frames) << phase << frames * frame;
  }
  void theWorstPhaseOfAFrameCounts() {
    QFETCH(double, phase);
    QFETCH(double, exposure);
    for (int delay : {0, 2, 5}) {
      Stage stage;
      stage.delay = delay;
      stage.clock = (180.0 + phase) * frame;
      QCOMPARE(measured(stage, exposure).frames, delay + 1);
    }
  }

  void flickerIsToldInWords() {
    Stage stage;
    stage.flicker = 0.08;
    LatencySettings settings;
    settings.settled = 0.4;  // the measurement itself survives it
    const Latency latency = measured(stage, 0.002, settings);
    QVERIFY(latency.flicker > 0.02);
    QCOMPARE(latency.verdicts.size(), std::size_t{2});
    QVERIFY(mentions(english(messageOf(latency.verdicts[1])),
                     "expose whole frames of the projector, multiples of 16.67 ms"));
    Stage steady;
    QCOMPARE(measured(steady, 0.002).verdicts.size(), std::size_t{1});
  }

  void aCameraThatSeesNothingIsTold() {
    Stage stage;
    stage.isCovered = true;
    QVERIFY(mentions(sentenceOf([&] { measured(stage, 0.002); }, ErrorKind::device),
                     "stage camera: the camera sees no difference between white and black; aim it"));
  }

  void aPictureThatDoesNotComeIsTold() {
    Stage stage;
    stage.delay = 12;
    LatencySettings settings;
    settings.mostFrames = 8;
    // Black and white themselves come too late then: either of the two sentences is right.
    QVERIFY(!sentenceOf([&] { measured(stage, 0.002, settings); }, ErrorKind::device).empty());
  }

  void stoppingStops() {
    Stage stage;
    StageProjector projector(stage);
    StageCamera camera(stage);
    Stopped stopped;
    QVERIFY_THROWS_EXCEPTION(Cancelled, measureLatency(projector, camera, 0.002, {}, stage.wait(), stopped));
  }

  void problemsAreListed() {
    LatencySettings settings;
    settings.frame = 0.0;
    settings.mostFrames = 0;
    settings.repeats = 0;
    settings.settled = 1.0;
    QCOMPARE(problems(settings).size(), std::size_t{4});
    QVERIFY(problems(LatencySettings()).empty());
  }
};

QTEST_GUILESS_MAIN(TestLatency)
#include "test_latency.moc"
