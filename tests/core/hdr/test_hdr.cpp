// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "relucent/base/random.h"
#include "relucent/hdr/hdr.h"
#include "support/scripted_rig.h"

using namespace relucent;
using namespace relucent::hdr;
using namespace relucent::image;
using namespace relucent::rig;
using namespace relucent::transport;
using namespace relucent::test;

// Neither radiance nor what is only less e passes for what T predicts.
static_assert(!std::is_convertible_v<HdrFrame, LampLight> &&
              !std::is_convertible_v<ProjectedLight, LampLight>);
static_assert(!std::is_convertible_v<HdrFrame, BlackLevel> && !std::is_convertible_v<LampLight, BlackLevel>);
static_assert(!std::is_constructible_v<LampLight, HdrFrame, double>);

namespace {

constexpr Size size{37, 23};

/// Photographs of given radiances: one value per pixel and channel.
struct Sensor {
  int bits = 12;
  double readNoise = 1e-3;
  double gain = 1e-4;
  Curve response;  // linear -> signal
  double noise = 1.0;

  Shot photograph(const CameraStack& radiance, const std::vector<double>& seconds, std::uint64_t seed,
                  double timeError = 0.0) const {
    Shot shot{{"test", static_cast<int>(seed)}, "", {}};
    for (std::size_t k = 0; k < seconds.size(); ++k) {
      double factor = 1.0 + timeError * (2.0 * Random{seed, k}.uniform() - 1.0);
      RawFrame frame{Image(size, 3), bits, seconds[k]};
      for (std::size_t i = 0; i < radiance.size(); ++i) {
        double linear = radiance[i] * seconds[k] * factor;
        linear += noise * std::sqrt(readNoise * readNoise + gain * linear) * Random{seed, k, i}.normal();
        double signal = response ? response(std::clamp(linear, 0.0, 1.0)) : std::min(linear, 1.0);
        double codes = std::ldexp(1.0, bits) - 1.0;
        frame.signal.data()[i] =
            static_cast<float>(bits > 0 ? std::round(std::min(signal, 1.0) * codes) / codes : signal);
      }
      shot.frames.push_back({frame});
    }
    return shot;
  }

  CameraModel model() const {
    CameraModel camera;
    double step = bits > 0 ? 1.0 / (std::ldexp(1.0, bits) - 1.0) : 0.0;
    camera.readNoise = std::hypot(readNoise, step / std::sqrt(12.0));
    camera.gain = gain;
    return camera;
  }
};

Stack ladder(double darkest, double brightest) {
  CameraStack radiance(3 * size.count());
  for (std::size_t i = 0; i < radiance.size(); ++i)
    radiance[i] =
        static_cast<float>(darkest * std::pow(brightest / darkest,
                                              static_cast<double>(i) / static_cast<double>(radiance.size())));
  return radiance;
}

ResponseCurve inverseOf(const Curve& response) {
  std::vector<double> x{0.0}, y{0.0};
  for (int i = 1; i < 200; ++i) {
    double linear = std::pow(i / 200.0, 2.2);
    x.push_back(response(linear));
    y.push_back(linear);
  }
  x.push_back(1.0);
  y.push_back(1.0);
  return ResponseCurve(x, y);
}

}  // namespace

class TestHdr : public QObject {
  Q_OBJECT

 private slots:
  void noiselessBracketsAreExact_data() {
    QTest::addColumn<int>("bits");
    QTest::addColumn<QList<double>>("seconds");
    for (int bits : {0, 8, 10, 12, 16}) {
      QTest::addRow("%d bits, one exposure", bits) << bits << QList<double>{0.4};
      QTest::addRow("%d bits, two exposures", bits) << bits << QList<double>{1.6, 0.4};
      QTest::addRow("%d bits, three, unordered", bits) << bits << QList<double>{0.1, 1.6, 0.4};
    }
  }
  void noiselessBracketsAreExact() {
    QFETCH(int, bits);
    QFETCH(QList<double>, seconds);
    Sensor sensor;
    sensor.bits = bits;
    sensor.noise = 0.0;
    CameraStack radiance(ladder(0.01, 2.3));
    Shot shot = sensor.photograph(radiance, {seconds.begin(), seconds.end()}, 1);
    HdrFrame frame = mergeBracket(shot, {sensor.model()}, Rasters(size));
    // Each sample is off by half a code at most, so is their mean, in units of the shortest that counts;
    // floating point: single precision.
    double shortest = *std::min_element(seconds.begin(), seconds.end());
    double halfCode = bits > 0 ? 0.5 / (std::ldexp(1.0, bits) - 1.0) : 0.0;
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      QCOMPARE(int(frame.valid[i]), 1);
      QVERIFY(std::abs(frame.radiance[i] - radiance[i]) <= halfCode / shortest + 1e-6 * radiance[i]);
    }
  }

  /// Chi square over pixels and repetitions: (L - truth)^2 / variance is 1 on average. Also no bias.
  void varianceIsTrue_data() {
    QTest::addColumn<int>("bits");
    QTest::addColumn<double>("readNoise");
    QTest::addColumn<double>("gain");
    QTest::addColumn<bool>("curve");
    QTest::newRow("12 bits") << 12 << 1e-3 << 1e-4 << false;
    QTest::newRow("8 bits, rounding counts") << 8 << 1.5e-3 << 5e-5 << false;
    QTest::newRow("much photon noise") << 12 << 1e-3 << 1e-3 << false;
    QTest::newRow("read noise only") << 16 << 4e-3 << 0.0 << false;
    QTest::newRow("floating point") << 0 << 1e-3 << 1e-4 << false;
    QTest::newRow("response curve") << 10 << 1e-3 << 1e-4 << true;
  }
  void varianceIsTrue() {
    QFETCH(int, bits);
    QFETCH(double, readNoise);
    QFETCH(double, gain);
    QFETCH(bool, curve);
    Sensor sensor{bits, readNoise, gain, {}, 1.0};
    CameraModel model = sensor.model();
    if (curve) {
      sensor.response = [](double x) { return std::pow(x, 1.0 / 1.8); };
      model.response.fill(inverseOf(sensor.response));
    }
    // Down to where the longest exposure stays clear of being cut at zero: 6 sigma of read noise.
    CameraStack radiance(ladder(6.0 * readNoise / 1.6 + 0.01, 2.3));
    constexpr int repetitions = 40;
    double chiSquare = 0.0, errors = 0.0, deviations = 0.0;
    std::size_t count = 0;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      Shot shot = sensor.photograph(radiance, {1.6, 0.4, 0.1}, 100 + static_cast<std::uint64_t>(repetition));
      HdrFrame frame = mergeBracket(shot, {model}, Rasters(size));
      for (std::size_t i = 0; i < radiance.size(); ++i) {
        double error = frame.radiance[i] - radiance[i];
        chiSquare += error * error / frame.variance[i];
        errors += error;
        deviations += std::sqrt(frame.variance[i]);
        ++count;
      }
    }
    double n = static_cast<double>(count);
    // The sum of n squares has deviation sqrt(2 n): 5 of them. Beyond that 2 %: near saturation the choice of
    // exposures still follows noise a little, and a response curve bends it.
    QVERIFY2(std::abs(chiSquare / n - 1.0) < 5.0 * std::sqrt(2.0 / n) + 0.02,
             qPrintable(QString::number(chiSquare / n)));
    // Over the whole range the README states less than 0.02 standard deviations.
    double bias = errors / deviations;
    QVERIFY2(std::abs(bias) < 0.02 + 5.0 / std::sqrt(n), qPrintable(QString::number(bias)));
  }

  /// The law that weights do not follow noise, where they easily would: dim light, strong photon noise, and
  /// around saturation of the longer exposure.
  void weightsDoNotFollowNoise_data() {
    QTest::addColumn<double>("radiance");
    for (double value : {0.02, 0.05, 0.2, 0.55, 0.58, 0.6, 0.605, 0.61, 0.65, 1.0, 2.0})
      QTest::addRow("%.3f", value) << value;
  }
  void weightsDoNotFollowNoise() {
    QFETCH(double, radiance);
    Sensor sensor{14, 2e-3, 5e-4, {}, 1.0};
    CameraStack even(3 * size.count(), static_cast<float>(radiance));
    double sum = 0.0, deviation = 0.0, n = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      HdrFrame frame =
          mergeBracket(sensor.photograph(even, {1.6, 0.4}, seed), {sensor.model()}, Rasters(size));
      for (std::size_t i = 0; i < even.size(); ++i) {
        sum += frame.radiance[i];
        deviation += std::sqrt(frame.variance[i]);
        n += 1.0;
      }
    }
    double bias = (sum / n - even[0]) / (deviation / n);
    // 5 standard errors, and what the README states: 0.15 deviations where trust fades, 0.02 elsewhere.
    bool edge = radiance * 1.6 > 0.65 && radiance * 1.6 < 1.05;
    QVERIFY2(std::abs(bias) < 5.0 / std::sqrt(n) + (edge ? 0.15 : 0.02), qPrintable(QString::number(bias)));
  }

  void saturationLeavesALowerBound() {
    Sensor sensor;
    CameraStack radiance(ladder(0.5, 40.0));
    HdrFrame frame =
        mergeBracket(sensor.photograph(radiance, {0.4, 0.1}, 1), {sensor.model()}, Rasters(size));
    int saturated = 0;
    for (std::size_t i = 0; i < radiance.size(); ++i) {
      if (frame.valid[i] != 0) {
        QVERIFY(radiance[i] < 11.0f);
        continue;
      }
      ++saturated;
      QVERIFY(frame.radiance[i] <= radiance[i] * 1.1f);
      QVERIFY(std::abs(frame.radiance[i] - 9.7f) < 1e-4f);
      QVERIFY(frame.variance[i] > 90.0f);
    }
    QVERIFY(saturated > 100);
  }

  void longerExposuresOnlyHelp() {
    Sensor sensor;
    CameraStack radiance(ladder(0.01, 2.3));
    HdrFrame one = mergeBracket(sensor.photograph(radiance, {0.4}, 1), {sensor.model()}, Rasters(size));
    HdrFrame two = mergeBracket(sensor.photograph(radiance, {0.4, 3.2}, 1), {sensor.model()}, Rasters(size));
    for (std::size_t i = 0; i < radiance.size(); ++i) QVERIFY(two.variance[i] <= one.variance[i] * 1.3f);
    QVERIFY(two.variance[10] < 0.05f * one.variance[10]);
  }

  void camerasAreStacked() {
    SyntheticSettings scene;
    scene.cameras = {{19, 11}, {8, 13}};
    TransportMatrix transport = syntheticTransport(scene);
    ScriptedSettings settings;
    settings.cameras = {{.bits = 12}, {.bits = 16}};
    ScriptedVenue venue(transport, syntheticBlack(transport), settings);
    Rig rig = venue.rig();
    NoShotLog log;
    ShotTaker taker(rig, log, "test");
    std::vector<Image> white{Image({32, 24}, 3, 1.0f)};
    Shot shot = taker.take(white, {0.05, 0.01}, Progress());

    std::vector<CameraModel> models(2);
    for (CameraModel& model : models) model.readNoise = 1e-3, model.gain = 1e-4;
    HdrFrame frame = mergeBracket(shot, models, rig.cameraRasters());
    Stack truth = venue.radiance(white);
    QCOMPARE(frame.radiance.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
      QVERIFY(std::abs(frame.radiance[i] - truth[i]) < 5.5f * std::sqrt(frame.variance[i]));
  }

  void meansHaveTheVarianceOfMeans() {
    HdrFrame a{{1, 2, 9}, {4, 4, 81}, {1, 1, 0}}, b{{3, 7, 8}, {4, 49, 64}, {1, 0, 0}};
    HdrFrame mean = meanOf({a, b});
    QCOMPARE(mean.radiance, (Stack{2, 2, 9}));
    QCOMPARE(mean.variance, (Stack{2, 4, 81}));
    QCOMPARE(mean.valid, (std::vector<std::uint8_t>{1, 1, 0}));
    QCOMPARE(meanOf({b, a}).radiance, mean.radiance);
  }

  void trueTimesAreUsed() {
    CameraModel camera;
    QCOMPARE(trueSeconds(camera, 0.3), 0.3);
    camera.times = {{0.1, 1.1}, {1.0, 0.9}};
    QCOMPARE(trueSeconds(camera, 0.1), 0.1 * 1.1);
    QCOMPARE(trueSeconds(camera, 1.0), 0.9);
    QCOMPARE(trueSeconds(camera, 0.01), 0.01 * 1.1);
    QCOMPARE(trueSeconds(camera, 5.0), 5.0 * 0.9);
    QVERIFY(std::abs(trueSeconds(camera, std::sqrt(0.1)) / std::sqrt(0.1) - 1.0) < 1e-12);
  }

  void exposureRatiosAreRecovered_data() {
    QTest::addColumn<int>("bits");
    QTest::addColumn<bool>("curve");
    QTest::addColumn<quint64>("seed");
    for (quint64 seed = 1; seed <= 4; ++seed)
      for (int bits : {0, 8, 12}) {
        QTest::addRow("%d bits, seed %llu", bits, seed) << bits << false << seed;
        QTest::addRow("%d bits, response curve, seed %llu", bits, seed) << bits << true << seed;
      }
  }
  void exposureRatiosAreRecovered() {
    QFETCH(int, bits);
    QFETCH(bool, curve);
    QFETCH(quint64, seed);
    Sensor sensor{bits, 1e-3, 1e-4, {}, 1.0};
    CameraModel model = sensor.model();
    if (curve) {
      sensor.response = [](double x) { return std::pow(x, 1.0 / 1.8); };
      model.response.fill(inverseOf(sensor.response));
    }
    std::vector<double> seconds{1.6, 0.1, 0.4};
    CameraStack radiance(ladder(0.05, 8.0));
    // Outliers: a tenth of the pixels changes between the exposures.
    Shot shot = sensor.photograph(radiance, seconds, seed, 0.05);
    for (std::size_t i = 0; i < radiance.size(); i += 10) shot.frames[2][0].signal.data()[i] *= 0.5f;
    std::vector<double> ratios = exposureRatios(shot, 0, model);
    auto factor = [&](std::size_t k) { return 1.0 + 0.05 * (2.0 * Random{seed, k}.uniform() - 1.0); };
    for (std::size_t k = 0; k < seconds.size(); ++k) {
      double truth = seconds[k] * factor(k) / (seconds[0] * factor(0));
      // Some 500 pixels, each good to 2 to 5 %, over two steps: a standard error of about 0.2 %.
      QVERIFY2(std::abs(ratios[k] / truth - 1.0) < 0.01,
               qPrintable(QString("%1 for %2").arg(ratios[k]).arg(truth)));
    }
  }

  void withoutLightTheReportedTimesStand() {
    Sensor sensor;
    Shot shot = sensor.photograph(CameraStack(3 * size.count(), 1e-4f), {1.6, 0.4}, 1);
    QCOMPARE(exposureRatios(shot, 0, sensor.model()), (std::vector<double>{1.0, 0.25}));
  }
};

QTEST_APPLESS_MAIN(TestHdr)
#include "test_hdr.moc"
