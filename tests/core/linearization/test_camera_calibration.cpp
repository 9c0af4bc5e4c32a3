// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "relucent/base/message.h"
#include "relucent/linearization/camera_noise.h"
#include "relucent/linearization/camera_response.h"
#include "relucent/linearization/exposure_choice.h"
#include "relucent/linearization/test_light.h"
#include "support/scripted_rig.h"

using namespace relucent;
using namespace relucent::hdr;
using namespace relucent::image;
using namespace relucent::linearization;
using namespace relucent::rig;
using namespace relucent::transport;
using namespace relucent::test;

namespace {

ScriptedVenue venueWith(ScriptedCamera camera, std::uint64_t seed, double brightness = 20.0) {
  SyntheticSettings scene;
  scene.cameras = {{80, 60}};
  scene.brightness = brightness;
  scene.seed = seed;
  TransportMatrix transport = syntheticTransport(scene);
  ScriptedSettings settings;
  settings.cameras = {std::move(camera)};
  settings.seed = seed;
  CameraStack black = syntheticBlack(transport);
  return ScriptedVenue(std::move(transport), std::move(black), settings);
}

Shot take(const ScriptedVenue& venue, Drive drive, const std::vector<double>& seconds, int number = 0) {
  Rig rig = venue.rig();
  NoShotLog log;
  ShotTaker taker(rig, log, "test " + std::to_string(number));
  return taker.take(evenPatterns(rig, drive), seconds, Progress());
}

std::vector<ShotPair> pairsOf(const ScriptedVenue& venue) {
  std::vector<ShotPair> pairs;
  int number = 0;
  for (float drive : {1.0f, 0.75f, 0.5f, 0.0f}) {
    Shot first = take(venue, {drive, drive, drive}, {0.48, 0.04}, number++);
    pairs.emplace_back(std::move(first), take(venue, {drive, drive, drive}, {0.48, 0.04}, number++));
  }
  return pairs;
}

}  // namespace

class TestCameraCalibration : public QObject {
  Q_OBJECT

 private slots:
  void noiseIsMeasured_data() {
    QTest::addColumn<int>("bits");
    QTest::addColumn<double>("readNoise");
    QTest::addColumn<double>("gain");
    QTest::addColumn<quint64>("seed");
    for (quint64 seed = 1; seed <= 2; ++seed)
      for (int bits : {0, 8, 12, 16}) {
        QTest::addRow("%d bits, seed %llu", bits, seed) << bits << 1e-3 << 1e-4 << seed;
        QTest::addRow("%d bits, read noise, seed %llu", bits, seed) << bits << 5e-3 << 2e-5 << seed;
        QTest::addRow("%d bits, photon noise, seed %llu", bits, seed) << bits << 1e-3 << 1e-3 << seed;
      }
  }
  void noiseIsMeasured() {
    QFETCH(int, bits);
    QFETCH(double, readNoise);
    QFETCH(double, gain);
    QFETCH(quint64, seed);
    ScriptedCamera camera;
    camera.bits = bits;
    camera.readNoise = readNoise;
    camera.gain = gain;
    CameraModel model = withMeasuredNoise(CameraModel(), pairsOf(venueWith(camera, seed)), 0);
    double step = bits > 0 ? 1.0 / (std::ldexp(1.0, bits) - 1.0) : 0.0;
    double truth = std::hypot(readNoise, step / std::sqrt(12.0));
    // What the weights need: the variance that the model gives, to 10 %, wherever signals lie. 14400 values
    // a frame make bins of a thousand and more: 5 % each, less on the line.
    for (double linear : {0.02, 0.05, 0.1, 0.3, 0.9}) {
      double expected = truth * truth + gain * linear;
      QVERIFY2(
          std::abs(linearVariance(model, linear) / expected - 1.0) < 0.1,
          qPrintable(QString("%1: %2 for %3").arg(linear).arg(linearVariance(model, linear)).arg(expected)));
    }
    // At black the line is extended beyond the data, which end 5 deviations above zero; where photon noise
    // rules there already, the read noise is known from below only.
    double clear = 25.0 * gain;
    double share = truth * truth / (truth * truth + gain * clear);
    double tolerance = share > 0.2 ? 0.25 : 0.6;
    QVERIFY2(std::abs(model.readNoise / truth - 1.0) < tolerance,
             qPrintable(QString("%1 for %2").arg(model.readNoise).arg(truth)));
  }

  void noiselessCamerasGetTheFloors() {
    ScriptedCamera camera;
    camera.bits = 0;
    camera.readNoise = camera.gain = 0.0;
    CameraModel model = withMeasuredNoise(CameraModel(), pairsOf(venueWith(camera, 1)), 0);
    QVERIFY(model.readNoise > 0.0 && model.gain > 0.0);
    QVERIFY(std::isfinite(model.readNoise) && std::isfinite(model.gain));
  }

  void linearCamerasStayLinear_data() {
    QTest::addColumn<int>("bits");
    QTest::addColumn<double>("timeError");
    QTest::addColumn<quint64>("seed");
    for (quint64 seed = 1; seed <= 5; ++seed)
      for (int bits : {0, 8, 12}) {
        QTest::addRow("%d bits, seed %llu", bits, seed) << bits << 0.0 << seed;
        QTest::addRow("%d bits, times 5 %% off, seed %llu", bits, seed) << bits << 0.05 << seed;
      }
  }
  void linearCamerasStayLinear() {
    QFETCH(int, bits);
    QFETCH(double, timeError);
    QFETCH(quint64, seed);
    ScriptedCamera camera;
    camera.bits = bits;
    camera.timeError = timeError;
    Shot bracket = take(venueWith(camera, seed), {1, 1, 1}, responseBracket({1e-4, 10.0}, {0.48, 0.04}));
    CameraResponse response = cameraResponse(bracket, 0, 0.97);
    QVERIFY2(
        response.curves[0].isIdentity() && response.curves[1].isIdentity() && response.curves[2].isIdentity(),
        qPrintable(QString("exponent %1, shape %2").arg(response.exponent).arg(response.deviation)));
    if (timeError == 0.0) QVERIFY(std::abs(response.exponent - 1.0) < 0.01);
  }

  /// A response that repeats itself from step to step of the bracket fits as well as a straight one.
  void noResponseFitsLinearLightButTheStraightOne_data() {
    QTest::addColumn<double>("longest");
    QTest::addColumn<double>("shortest");
    QTest::newRow("two exposures") << 0.48 << 0.04;
    QTest::newRow("three") << 0.12 << 0.0034;
    QTest::newRow("one") << 0.04 << 0.04;
  }
  void noResponseFitsLinearLightButTheStraightOne() {
    QFETCH(double, longest);
    QFETCH(double, shortest);
    std::vector<double> seconds = responseBracket({1e-4, 10.0}, {longest, shortest});
    QVERIFY(seconds.size() >= 3);
    QVERIFY(seconds.front() == longest && seconds.back() >= 0.24 * shortest);
    // Periods in ln z that a wobble between knots can have. It must not come back to itself at all steps.
    for (double period = 0.3; period < 1.5; period += 0.01) {
      double farthest = 0.0;
      for (std::size_t k = 1; k < seconds.size(); ++k) {
        double turns = std::log(seconds[k - 1] / seconds[k]) / period;
        farthest = std::max(farthest, std::abs(turns - std::round(turns)));
      }
      QVERIFY2(farthest > 0.05, qPrintable(QString("period %1").arg(period)));
    }
  }

  void responseCurvesAreRecovered_data() {
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("shape");
    QTest::addColumn<quint64>("seed");
    for (quint64 seed = 1; seed <= 2; ++seed)
      for (int bits : {0, 8, 12})
        for (int shape = 0; shape < 3; ++shape)
          QTest::addRow("%d bits, shape %d, seed %llu", bits, shape, seed) << bits << shape << seed;
  }
  void responseCurvesAreRecovered() {
    QFETCH(int, bits);
    QFETCH(int, shape);
    QFETCH(quint64, seed);
    ScriptedCamera camera;
    camera.bits = bits;
    // A power law, sRGB, and a shoulder.
    camera.response = [shape](double x) {
      if (shape == 0) return std::pow(x, 1.0 / 2.2);
      if (shape == 1) return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
      return 1.4 * x / (x + 0.4);
    };
    Shot bracket = take(venueWith(camera, seed), {1, 1, 1}, responseBracket({1e-4, 10.0}, {0.48, 0.04}));
    CameraResponse response = cameraResponse(bracket, 0, 0.97);
    for (const ResponseCurve& curve : response.curves) {
      QVERIFY(!curve.isIdentity());
      // Up to a factor, which the units of radiance take up; fixed in the middle.
      double factor = 0.3 / curve(camera.response(0.3));
      for (double linear : {0.02, 0.05, 0.1, 0.2, 0.5, 0.8}) {
        double found = factor * curve(camera.response(linear));
        // 3 %: what counts as linear. The a priori smoothness and times pull by about that.
        QVERIFY2(std::abs(found / linear - 1.0) < 0.03,
                 qPrintable(QString("%1 for %2").arg(found).arg(linear)));
      }
    }
  }

  void fewExposuresTellLinearCameras_data() {
    QTest::addColumn<int>("shape");
    QTest::addColumn<int>("bits");
    QTest::addColumn<double>("timeError");
    QTest::addColumn<bool>("linear");
    for (int bits : {0, 8, 12}) {
      QTest::addRow("linear, %d bits", bits) << 0 << bits << 0.0 << true;
      QTest::addRow("linear, times 2 %% off, %d bits", bits) << 0 << bits << 0.02 << true;
      QTest::addRow("power law, %d bits", bits) << 1 << bits << 0.0 << false;
      QTest::addRow("slight power law, %d bits", bits) << 2 << bits << 0.0 << false;
      QTest::addRow("sRGB, %d bits", bits) << 3 << bits << 0.0 << false;
      QTest::addRow("a shoulder, %d bits", bits) << 4 << bits << 0.0 << false;
    }
  }
  void fewExposuresTellLinearCameras() {
    QFETCH(int, shape);
    QFETCH(int, bits);
    QFETCH(double, timeError);
    QFETCH(bool, linear);
    ScriptedCamera camera;
    camera.bits = bits;
    camera.timeError = timeError;
    if (shape > 0)
      camera.response = [shape](double x) {
        if (shape == 1) return std::pow(x, 1.0 / 2.2);
        if (shape == 2) return std::pow(x, 1.0 / 1.1);
        if (shape == 3) return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
        return 1.4 * x / (x + 0.4);
      };
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Shot bracket = take(venueWith(camera, seed), {1, 1, 1}, {0.48, 0.1, 0.04});
      QCOMPARE(looksLinear(bracket, 0, 0.97), linear);
    }
  }

  /// An even wall shows a camera few signals; noise must not make a response of them.
  void anEvenWallLeavesALinearCameraLinear() {
    SyntheticSettings scene;
    TransportMatrix even = syntheticTransport(scene);
    const CameraStack flood = even.floodlight();
    Stack factor(flood.size(), 1.0f);
    for (std::size_t i = 0; i < factor.size(); ++i) factor[i] = 15.0f / std::max(flood[i], 1.0f);
    TransportMatrix wall(even.cameras(), even.projectors(), even.ownLeaves().withRowsScaled(factor));
    CameraStack black = syntheticBlack(wall);
    ScriptedVenue venue(std::move(wall), std::move(black));
    QVERIFY(looksLinear(take(venue, {1, 1, 1}, {0.6, 0.1, 0.05, 0.006}), 0, 0.97));
  }

  void trueTimesAreMeasured_data() {
    QTest::addColumn<quint64>("seed");
    for (quint64 seed = 1; seed <= 5; ++seed) QTest::addRow("seed %llu", seed) << seed;
  }
  void trueTimesAreMeasured() {
    QFETCH(quint64, seed);
    ScriptedCamera camera;
    camera.timeError = 0.05;
    ScriptedVenue venue = venueWith(camera, seed);
    CameraModel model = withMeasuredTimes(CameraModel(), pairsOf(venue), 0);
    QCOMPARE(model.times.size(), std::size_t{2});
    QCOMPARE(model.times.front().scale, 1.0);

    // The truth: a noiseless camera with the same times.
    ScriptedCamera exact = camera;
    exact.bits = 0;
    exact.readNoise = exact.gain = 0.0;
    Shot shot = take(venueWith(exact, seed), {0.5, 0.5, 0.5}, {0.48, 0.04});
    double truth = exposureRatios(shot, 0, CameraModel())[1] * 12.0;
    QVERIFY2(std::abs(model.times.back().scale * truth - 1.0) < 2e-3,
             qPrintable(QString("%1 for %2").arg(model.times.back().scale).arg(1.0 / truth)));
  }

  void exposuresFitTheLight_data() {
    QTest::addColumn<double>("brightness");
    QTest::addColumn<int>("shape");
    for (double brightness : {1.5, 20.0, 400.0})
      for (int shape = 0; shape < 2; ++shape)
        QTest::addRow("%.1f, %s", brightness, shape == 0 ? "linear" : "curved") << brightness << shape;
  }
  void exposuresFitTheLight() {
    QFETCH(double, brightness);
    QFETCH(int, shape);
    ScriptedCamera camera;
    if (shape == 1) camera.response = [](double x) { return std::pow(x, 1.0 / 2.2); };
    ScriptedVenue venue = venueWith(camera, 1, brightness);
    Rig rig = venue.rig();
    NoShotLog log;
    ShotTaker taker(rig, log, "exposures");
    Progress progress;
    ExposureChoice choice = chooseExposures(taker, progress);
    QVERIFY(choice.findings.empty());
    QCOMPARE(choice.seconds.size(), std::size_t{2});
    QVERIFY(choice.seconds.front() > choice.seconds.back());
    QVERIFY(choice.seconds.front() <= 12.01 * choice.seconds.back());
    QCOMPARE(choice.flood, std::vector{choice.seconds.back()});
    QCOMPARE(choice.dim, std::vector{choice.seconds.front()});
    QVERIFY(atExposures(choice.whites, choice.seconds).has_value());
    QVERIFY(!atExposures(choice.whites, {7.0}).has_value());
    QVERIFY2(taker.exposures() <= (shape == 0 ? 8 : 9), qPrintable(QString::number(taker.exposures())));

    Shot flood = take(venue, {1, 1, 1}, {choice.seconds.back()});
    std::vector<float> top;
    for (std::size_t i = 0; i < flood.frames[0][0].signal.pixels(); ++i) {
      auto pixel = flood.frames[0][0].signal.pixel(i);
      top.push_back(*std::max_element(pixel.begin(), pixel.end()));
    }
    std::sort(top.begin(), top.end());
    double level = static_cast<double>(top[top.size() * 995 / 1000]);
    QVERIFY2(level > 0.7 && level < 0.86, qPrintable(QString::number(level)));
  }

  /// Law: where light changes with a period, every photograph has whole periods of it, and exposures still
  /// fit the light as well as such times can.
  void exposuresAreWholePeriods_data() {
    QTest::addColumn<double>("brightness");
    QTest::addColumn<double>("period");
    for (double period : {1.0 / 60.0, 0.01})
      for (double brightness : {1.5, 4.0, 20.0})
        QTest::addRow("%.4f s, %.1f", period, brightness) << brightness << period;
  }
  void exposuresAreWholePeriods() {
    QFETCH(double, brightness);
    QFETCH(double, period);
    ScriptedCamera camera;
    ScriptedVenue venue = venueWith(camera, 1, brightness);
    Rig rig = venue.rig();
    NoShotLog log;
    ShotTaker taker(rig, log, "exposures");
    Progress progress;
    const ExposureChoice any = chooseExposures(taker, progress),
                         whole = chooseExposures(taker, progress, period);
    for (const Shot& white : whole.whites)
      for (double seconds : white.exposuresAsked)
        QVERIFY2(std::abs(seconds / period - std::round(seconds / period)) < 1e-6 && seconds > 0.5 * period,
                 qPrintable(QString::number(seconds)));
    QVERIFY(!whole.seconds.empty() && !whole.flood.empty());
    QVERIFY(whole.seconds.back() >= period * (1.0 - 1e-9));
    QVERIFY(whole.seconds.back() <= std::max(period, 1.1 * any.seconds.back()) * (1.0 + 1e-9));
  }

  void highlightsGetAnExposure_data() {
    QTest::addColumn<double>("brighter");
    QTest::addColumn<double>("shortest");
    QTest::addColumn<int>("exposures");
    QTest::newRow("no highlight") << 1.0 << 1e-4 << 2;
    QTest::newRow("a glint") << 6.0 << 1e-4 << 3;
    QTest::newRow("a caustic") << 40.0 << 1e-4 << 4;
    QTest::newRow("beyond the camera") << 40.0 << 0.01 << 3;
  }
  void highlightsGetAnExposure() {
    QFETCH(double, brighter);
    QFETCH(double, shortest);
    QFETCH(int, exposures);
    SyntheticSettings scene;
    scene.cameras = {{80, 60}};
    TransportMatrix plain = syntheticTransport(scene);
    Stack factor(3 * plain.cameras().count(), 1.0f);
    std::size_t highlight = 30 * 80 + 40;
    for (std::size_t c = 0; c < 3; ++c) factor[3 * highlight + c] = static_cast<float>(brighter);
    TransportMatrix transport(plain.cameras(), plain.projectors(), plain.ownLeaves().withRowsScaled(factor));
    CameraStack black = syntheticBlack(transport);
    ScriptedSettings settings;
    ScriptedCamera camera;
    camera.exposures.shortest = shortest;
    settings.cameras = {camera};
    ScriptedVenue venue(std::move(transport), std::move(black), settings);
    Rig rig = venue.rig();
    NoShotLog log;
    ShotTaker taker(rig, log, "exposures");
    Progress progress;
    ExposureChoice choice = chooseExposures(taker, progress);
    QCOMPARE(int(choice.seconds.size()), exposures);
    QVERIFY(std::is_sorted(choice.seconds.rbegin(), choice.seconds.rend()));
    for (std::size_t i = 1; i < choice.seconds.size(); ++i)
      QVERIFY(choice.seconds[i - 1] <= 16.01 * choice.seconds[i]);
    Image seen = take(venue, {1, 1, 1}, {choice.seconds.back()}).frames[0][0].signal;
    float most = *std::max_element(seen.pixel(highlight).begin(), seen.pixel(highlight).end());
    bool reached = choice.seconds.back() > 1.01 * shortest;
    QCOMPARE(most < 0.95f, reached);
    QCOMPARE(choice.findings.empty(), reached);
  }

  void limitsOfTheCameraAreFindings_data() {
    QTest::addColumn<double>("shortest");
    QTest::addColumn<double>("longest");
    QTest::addColumn<QString>("says");
    QTest::addColumn<int>("exposures");
    QTest::newRow("too bright") << 0.5 << 8.0 << "overexposed" << 2;
    QTest::newRow("too dark") << 1e-4 << 2e-3 << "reaches only" << 1;
    QTest::newRow("no longer one") << 1e-3 << 0.06 << "" << 1;
    QTest::newRow("one exposure time only") << 0.03 << 0.03 << "" << 1;
  }
  void limitsOfTheCameraAreFindings() {
    QFETCH(double, shortest);
    QFETCH(double, longest);
    QFETCH(QString, says);
    QFETCH(int, exposures);
    ScriptedCamera camera;
    camera.exposures = {shortest, longest};
    ScriptedVenue venue = venueWith(camera, 1, 20.0);
    Rig rig = venue.rig();
    NoShotLog log;
    ShotTaker taker(rig, log, "exposures");
    Progress progress;
    ExposureChoice choice = chooseExposures(taker, progress);
    QCOMPARE(int(choice.seconds.size()), exposures);
    for (double seconds : choice.seconds) QVERIFY(seconds >= shortest && seconds <= longest);
    QCOMPARE(choice.findings.empty(), says.isEmpty());
    if (!says.isEmpty()) QVERIFY(QString::fromStdString(english(choice.findings.front())).contains(says));
  }

  void clippingBelowFullScaleIsSeen() {
    ScriptedCamera camera;
    camera.response = [](double x) { return std::min(x, 0.5); };
    ScriptedVenue venue = venueWith(camera, 1);
    Rig rig = venue.rig();
    NoShotLog log;
    ShotTaker taker(rig, log, "exposures");
    Progress progress;
    ExposureChoice choice = chooseExposures(taker, progress);
    QVERIFY(std::abs(choice.saturation.front() - 0.485) < 2e-3);
  }
};

QTEST_APPLESS_MAIN(TestCameraCalibration)
#include "test_camera_calibration.moc"
