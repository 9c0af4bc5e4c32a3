// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/pjlink/steady_light.h"
#include "support/sentences.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::pjlink;

namespace {

/// Lamps whose power is a function of time, a room's light, and one camera.
struct Room {
  std::vector<std::function<double(double seconds)>> lamps;
  std::function<double(double seconds)> daylight = [](double) { return 0.0; };
  double noise = 0.0;       // of a photograph's mean, relative to full scale
  double photograph = 0.0;  // seconds that one takes
  double seconds = 0.0;
  std::vector<float> drive{};
  std::vector<double> exposures{};  // asked for
  int shots = 0;

  Waiting waiting() {
    return {
        [this] {
          return Waiting::Time(
              std::chrono::duration_cast<Waiting::Time::duration>(std::chrono::duration<double>(seconds)));
        },
        [this](std::chrono::milliseconds time) { seconds += std::chrono::duration<double>(time).count(); }};
  }

  struct Lamp : rig::Projector {
    Room& room;
    std::size_t which;
    Lamp(Room& of, std::size_t number) : room(of), which(number) {}
    std::string name() const override { return "lamp"; }
    Size size() const override { return {8, 8}; }
    int bits() const override { return 8; }
    void show(const image::Image& encodedDrive) override { room.drive[which] = encodedDrive.data().front(); }
  };
  struct Eye : rig::Camera {
    Room& room;
    explicit Eye(Room& of) : room(of) {}
    std::string name() const override { return "eye"; }
    Size size() const override { return {8, 8}; }
    rig::ExposureRange exposures() const override { return {1e-3, 4.0}; }
    rig::RawFrame capture(const rig::CaptureRequest& request) override {
      double light = room.daylight(room.seconds);
      for (std::size_t i = 0; i < room.lamps.size(); ++i)
        light += static_cast<double>(room.drive[i]) * room.lamps[i](room.seconds);
      Random random{26, static_cast<std::uint64_t>(room.shots++)};
      const double signal = light * request.seconds + room.noise * random.normal();
      room.seconds += room.photograph;
      room.exposures.push_back(request.seconds);
      return {image::Image({8, 8}, 3, static_cast<float>(std::clamp(signal, -1.0, 1.0))), 0, request.seconds};
    }
  };
  rig::Rig rig() {
    rig::Rig made;
    drive.assign(lamps.size(), 0.0f);
    for (std::size_t i = 0; i < lamps.size(); ++i)
      made.projectors.push_back(std::make_unique<Lamp>(*this, i));
    made.cameras.push_back(std::make_unique<Eye>(*this));
    return made;
  }

  SteadyLight await(SteadyLightSettings settings = {}) {
    Progress quiet;
    rig::Rig devices = rig();
    return awaitSteadyLight(devices, settings, waiting(), quiet);
  }
};

/// Rises towards `power` with a time constant, as lamps do.
auto lamp(double constant, double power = 10.0, double begin = 0.6) {
  return [=](double seconds) { return power * (1.0 - (1.0 - begin) * std::exp(-seconds / constant)); };
}

}  // namespace

class TestSteadyLight : public QObject {
  Q_OBJECT

 private slots:
  /// The drift of a straight line is what it says, and noise hides no more than its deviation tells.
  void driftOfALine_data() {
    QTest::addColumn<double>("slope");  // relative, over the span
    QTest::addColumn<double>("noise");
    for (double slope : {0.0, 0.004, -0.02, 0.5})
      for (double noise : {0.0, 0.001, 0.01}) QTest::addRow("%g %g", slope, noise) << slope << noise;
  }
  void driftOfALine() {
    QFETCH(double, slope);
    QFETCH(double, noise);
    Random random{3, static_cast<std::uint64_t>(1e4 * (slope + 1.0)),
                  static_cast<std::uint64_t>(1e4 * noise)};
    std::vector<LightSample> samples;
    for (int i = 0; i <= 12; ++i)
      samples.push_back({10.0 * i, 5.0 * (1.0 + slope * (i / 12.0 - 0.5)) + 5.0 * noise * random.normal()});
    const auto drift = driftOf(samples, 120.0);
    QVERIFY(drift);
    // Of three deviations of a slope through 13 points: noise sqrt(12 / n).
    QVERIFY(std::abs(drift->drift - std::abs(slope)) <= 3.0 * noise + 1e-9);
    QVERIFY(drift->deviation <= 2.5 * noise + 1e-9);
  }

  void tooFewSamplesTellNothing() {
    std::vector<LightSample> samples;
    for (int i = 0; i < 5; ++i) samples.push_back({30.0 * i, 1.0});
    QVERIFY(!driftOf(samples, 120.0));
    samples.clear();
    for (int i = 0; i < 12; ++i) samples.push_back({1.0 * i, 1.0});
    QVERIFY(!driftOf(samples, 120.0));
    for (LightSample& sample : samples) sample = {sample.seconds * 12.0, 0.0};
    QVERIFY(!driftOf(samples, 120.0));
  }

  void aSteadyLampTakesOneSpan() {
    Room room{.lamps = {[](double) { return 10.0; }}};
    const SteadyLight found = room.await();
    QVERIFY2(found.seconds >= 108.0 && found.seconds <= 130.0, qPrintable(QString::number(found.seconds)));
  }

  /// What is left of the rise when it is called steady is what the settings allow, however slow the lamp is.
  void aLampIsWaitedForAsLongAsItNeeds_data() {
    QTest::addColumn<double>("constant");
    QTest::addColumn<double>("noise");
    for (double constant : {20.0, 100.0, 300.0})
      for (double noise : {0.0, 5e-4}) QTest::addRow("%g s, noise %g", constant, noise) << constant << noise;
  }
  void aLampIsWaitedForAsLongAsItNeeds() {
    QFETCH(double, constant);
    QFETCH(double, noise);
    Room room{.lamps = {lamp(constant)}, .noise = noise};
    const SteadyLight found = room.await();
    const auto at = lamp(constant);
    const double rise = (at(found.seconds) - at(std::max(0.0, found.seconds - 120.0))) / at(found.seconds);
    // The share allowed and three deviations of the slope by noise, whose signal is above 0.15.
    QVERIFY2(rise <= 0.005 + 3.0 * noise / 0.15 + 1e-3,
             qPrintable(QString("%1 at %2 s").arg(rise).arg(found.seconds)));
    // Without waiting longer than a lamp that is as steady as that: e^(-t / constant) 0.4 (e^(120 / constant)
    // - 1).
    const double needed = constant * std::log(0.4 * (std::exp(120.0 / constant) - 1.0) / 0.005);
    QVERIFY2(found.seconds <= std::max(130.0, needed + 60.0),
             qPrintable(QString("%1 s, needed %2").arg(found.seconds).arg(needed)));
  }

  /// The sum of both is constant all the time.
  void oneLampThatRisesDoesNotHideAnotherThatFalls() {
    const auto rises = lamp(200.0, 10.0, 0.8);
    Room room{.lamps = {rises, [=](double seconds) { return 20.0 - rises(seconds); }}};
    QVERIFY(room.await().seconds > 300.0);
  }

  void daylightIsNoLamp() {
    Room room{.lamps = {[](double) { return 10.0; }},
              .daylight = [](double seconds) { return 1.0 + 0.01 * seconds; }};
    QVERIFY(room.await().seconds < 130.0);
  }

  void aSlowCameraTellsItToo() {
    Room room{.lamps = {lamp(100.0), lamp(50.0)}, .photograph = 12.0};
    const double seconds = room.await().seconds;
    QVERIFY2(seconds > 300.0 && seconds < 900.0, qPrintable(QString::number(seconds)));
  }

  /// Photographs that overflow tell no drift: a lamp of ten times its first power is still followed.
  void exposuresAreChosenAgain() {
    Room room{.lamps = {lamp(60.0, 100.0, 0.05)}};
    const double seconds = room.await().seconds;
    QVERIFY2(seconds > 200.0, qPrintable(QString::number(seconds)));
    QVERIFY(room.exposures.back() < 0.3 * room.exposures[5]);
  }

  void aLampThatNeverIsSteadyIsASentence() {
    Room room{.lamps = {[](double) { return 10.0; }, [](double seconds) { return 10.0 + 0.02 * seconds; }}};
    const std::string said = sentenceOf([&] { room.await(); }, ErrorKind::device);
    QVERIFY(mentions(said, "the light of projector 2 still drifts by"));
    QVERIFY(mentions(said, "within 120 s after 1800 s"));
    QVERIFY(mentions(said, "dynamic contrast"));
  }

  void aProjectorThatNobodySeesIsASentence() {
    Room room{.lamps = {[](double) { return 10.0; }, [](double) { return 0.0; }}};
    QVERIFY(mentions(sentenceOf([&] { room.await(); }, ErrorKind::device),
                     "no camera sees light of projector 2"));
  }

  void stoppingEndsIt() {
    Room room{.lamps = {lamp(100.0)}};
    rig::Rig devices = room.rig();
    Stopped stopped;
    QVERIFY_EXCEPTION_THROWN(awaitSteadyLight(devices, {}, room.waiting(), stopped), Cancelled);
  }

  void impossibleSettingsAreTold() {
    QVERIFY(problems(SteadyLightSettings()).empty());
    QCOMPARE(problems(SteadyLightSettings{.share = 0.0}).size(), std::size_t{1});
    QCOMPARE(problems(SteadyLightSettings{.interval = std::chrono::seconds(60)}).size(), std::size_t{1});
    QCOMPARE(problems(SteadyLightSettings{.longest = std::chrono::seconds(60)}).size(), std::size_t{1});
  }
};

QTEST_APPLESS_MAIN(TestSteadyLight)
#include "test_steady_light.moc"
