// SPDX-License-Identifier: MIT
#include <QTest>
#include <cmath>

#include "relucent/base/random.h"
#include "relucent/venue/projector_model.h"
#include "relucent/venue/sensor_model.h"
#include "relucent/venue/venue.h"

using namespace relucent;
using namespace relucent::image;
using namespace relucent::rig;
using namespace relucent::venue;

namespace {

VenueSettings smallVenue(const std::string& name = "corner") {
  VenueSettings settings;
  settings.name = name;
  settings.projector = {32, 24};
  settings.camera = {24, 18};
  settings.pathsPerPixel = 16;
  return settings;
}

SimulatedVenue traced(const VenueSettings& settings) {
  Progress progress;
  return SimulatedVenue(settings, {}, progress);
}

Image filled(Size size, float red, float green, float blue) {
  Image image(size, 3);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    image.pixel(i)[0] = red;
    image.pixel(i)[1] = green;
    image.pixel(i)[2] = blue;
  }
  return image;
}

RawFrame photograph(Rig& rig, const Image& picture, const CaptureRequest& request) {
  rig.projectors[0]->show(picture);
  return rig.cameras[0]->capture(request);
}

}  // namespace

class TestSimulatedDevices : public QObject {
  Q_OBJECT
 private slots:
  void sensorNoiseIsALine_data() {
    QTest::addColumn<double>("light");
    for (double light : {0.02, 0.1, 0.5, 0.9}) QTest::addRow("%g", light) << light;
  }
  /// mean = light * seconds, variance = mean / fullWell + (read / fullWell)^2 + step^2 / 12.
  void sensorNoiseIsALine() {
    QFETCH(double, light);
    DeviceModelSettings settings;
    Size size{256, 256};
    SensorModel sensor(settings, 5);
    RawFrame frame = sensor.expose(CameraStack(3 * size.count(), static_cast<float>(light / 0.01)), size,
                                   {{"noise", 1}, 0, 0.01});
    double sum = 0.0, square = 0.0, n = static_cast<double>(frame.signal.data().size());
    for (float value : frame.signal.data()) {
      sum += static_cast<double>(value);
      square += static_cast<double>(value) * static_cast<double>(value);
    }
    double mean = sum / n, variance = square / n - mean * mean;
    double read = settings.readElectrons / settings.fullWell, step = 1.0 / 4095.0;
    double expected = light / settings.fullWell + read * read + step * step / 12.0;
    qInfo("mean %.6f for %.6f, variance %.4g for %.4g", mean, light, variance, expected);
    // 196608 values: the mean's error is sqrt(variance / n), the variance's relative error sqrt(2 / n) = 0.3
    // %.
    QVERIFY(std::abs(mean - light) < 4.0 * std::sqrt(expected / n));
    QVERIFY(std::abs(variance / expected - 1.0) < 4.0 * std::sqrt(2.0 / n));
  }

  void sensorSaturatesAndCounts() {
    DeviceModelSettings settings;
    settings.cameraBits = 8;
    SensorModel sensor(settings, 5);
    Size size{16, 16};
    RawFrame bright = sensor.expose(CameraStack(3 * size.count(), 500.0f), size, {{"bright", 0}, 0, 0.01});
    for (float value : bright.signal.data()) QCOMPARE(value, 1.0f);
    RawFrame dim = sensor.expose(CameraStack(3 * size.count(), 30.0f), size, {{"dim", 0}, 0, 0.01});
    QCOMPARE(dim.bits, 8);
    for (float value : dim.signal.data())
      QVERIFY(std::abs(value * 255.0f - std::round(value * 255.0f)) < 1e-4f);
  }

  void sensorReportsTheExposureItGrants() {
    SensorModel sensor({}, 5);
    CameraStack light(3 * 4, 1.0f);
    QCOMPARE(sensor.expose(light, {2, 2}, {{"x", 0}, 0, 100.0}).seconds, SensorModel::exposures().longest);
    QCOMPARE(sensor.expose(light, {2, 2}, {{"x", 0}, 0, 1e-9}).seconds, SensorModel::exposures().shortest);
    QCOMPARE(sensor.expose(light, {2, 2}, {{"x", 0}, 0, 0.02}).seconds, 0.02);
  }

  void sensorResponseCurve() {
    DeviceModelSettings settings;
    settings.cameraGamma = 2.2;
    settings.readElectrons = 0.0;
    settings.fullWell = 1e9;
    RawFrame frame = SensorModel(settings, 5).expose(CameraStack(12, 25.0f), {2, 2}, {{"curve", 0}, 0, 0.01});
    QVERIFY(std::abs(static_cast<double>(frame.signal.at(0, 0, 0)) - std::pow(0.25, 1.0 / 2.2)) <
            1.0 / 4095.0);
  }

  /// The same shot is the same to the bit, whatever was photographed before; any other shot differs.
  void shotsRepeat() {
    SimulatedVenue venue = traced(smallVenue());
    Rig first = venue.rig(), second = venue.rig();
    Image picture = filled({32, 24}, 0.6f, 0.5f, 0.4f);
    RawFrame shot = photograph(first, picture, {{"ramp", 3}, 1, 0.01});
    photograph(second, filled({32, 24}, 1.0f, 0.0f, 0.0f), {{"ramp", 2}, 0, 0.02});
    QVERIFY(photograph(second, picture, {{"ramp", 3}, 1, 0.01}).signal == shot.signal);
    QVERIFY(!(photograph(second, picture, {{"ramp", 3}, 2, 0.01}).signal == shot.signal));
    QVERIFY(!(photograph(second, picture, {{"ramp", 4}, 1, 0.01}).signal == shot.signal));
    QVERIFY(!(photograph(second, picture, {{"other", 3}, 1, 0.01}).signal == shot.signal));
  }

  /// Light adds up: the photograph of two half patterns' sum is the sum of their photographs, less one black,
  /// within the noise of the three.
  void photographsSuperpose() {
    VenueSettings settings = smallVenue();
    settings.devices.cameraBits = 16;
    SimulatedVenue venue = traced(settings);
    Rig rig = venue.rig();
    Image left(settings.projector, 3), right = left, both = left, black = left;
    Random random({4});
    for (std::size_t i = 0; i < both.pixels(); ++i) {
      Image& half = random.uniform() < 0.5 ? left : right;
      for (std::size_t c = 0; c < 3; ++c)
        half.pixel(i)[c] = both.pixel(i)[c] = 0.5f + 0.5f * random.uniformFloat();
    }
    double seconds = 1.0 / 65.0;
    RawFrame frames[4] = {
        photograph(rig, both, {{"sum", 0}, 0, seconds}), photograph(rig, black, {{"sum", 1}, 0, seconds}),
        photograph(rig, left, {{"sum", 2}, 0, seconds}), photograph(rig, right, {{"sum", 3}, 0, seconds})};
    double chi = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < frames[0].signal.data().size(); ++i) {
      double difference = 0.0, variance = 0.0;
      bool usable = true;
      for (int k = 0; k < 4; ++k) {
        double value = static_cast<double>(frames[k].signal.data()[i]);
        difference += (k < 2 ? 1.0 : -1.0) * value;
        variance += value / settings.devices.fullWell + std::pow(6.0 / settings.devices.fullWell, 2.0);
        // At the ends of the scale the noise is cut off: four standard deviations above black.
        usable = usable && value < 0.97 && value > 0.0016;
      }
      if (!usable) continue;
      chi += difference * difference / variance;
      ++count;
    }
    qInfo("chi squared per value %.3f over %zu values", chi / static_cast<double>(count), count);
    QVERIFY2(count > 200, qPrintable(QString::number(count)));
    // Deviation of a mean of n squares: sqrt(2 / n); the weights know the signal only up to its noise.
    QVERIFY(std::abs(chi / static_cast<double>(count) - 1.0) <
            4.0 * std::sqrt(2.0 / static_cast<double>(count)) + 0.02);
  }

  void projectorResponses() {
    ProjectorModel model({});
    for (std::size_t channel = 0; channel < 3; ++channel) {
      QCOMPARE(model.response(channel, 0.0), 0.0);
      QVERIFY(std::abs(model.response(channel, 1.0) - 1.0) < 1e-12);
      double least = 1e9, most = 0.0;
      for (int code = 1; code < 255; ++code) {
        QVERIFY(model.response(channel, (code + 1) / 255.0) > model.response(channel, code / 255.0));
        double exponent = std::log(model.response(channel, code / 255.0)) / std::log(code / 255.0);
        least = std::min(least, exponent);
        most = std::max(most, exponent);
      }
      // A pure power law would have one exponent.
      QVERIFY2(most - least > 0.05, qPrintable(QString("%1 to %2").arg(least).arg(most)));
    }
    QVERIFY(std::abs(model.response(0, 0.5) - model.response(2, 0.5)) > 0.01);
  }

  void projectorRoundsAndClamps() {
    ProjectorModel model({});
    CameraStack light = model.light(filled({1, 1}, 0.5f, 128.0f / 255.0f, std::nanf("")));
    Stack again = model.light(filled({1, 1}, 128.3f / 255.0f, 127.6f / 255.0f, -3.0f));
    QCOMPARE(light, again);
    QCOMPARE(model.light(filled({1, 1}, 7.0f, 1.0f, 1.0f)), Stack({1.0f, 1.0f, 1.0f}));
  }

  void whiteSegmentBreaksAdditivity() {
    for (bool whiteSegment : {false, true}) {
      VenueSettings settings = smallVenue("plain");
      settings.devices.whiteSegment = whiteSegment;
      SimulatedVenue venue = traced(settings);
      Size size = settings.projector;
      CameraStack white = venue.trueRadiance({filled(size, 1, 1, 1)}),
                  red = venue.trueRadiance({filled(size, 1, 0, 0)}),
                  green = venue.trueRadiance({filled(size, 0, 1, 0)}),
                  blue = venue.trueRadiance({filled(size, 0, 0, 1)});
      const CameraStack& black = venue.trueBlack();
      double whole = 0.0, parts = 0.0;
      for (std::size_t i = 0; i < white.size(); ++i) {
        whole += static_cast<double>(white[i] - black[i]);
        parts += static_cast<double>(red[i] + green[i] + blue[i] - 3.0f * black[i]);
      }
      if (whiteSegment)
        QVERIFY(whole / parts > 1.2);
      else
        QVERIFY(std::abs(whole / parts - 1.0) < 1e-4);
    }
  }

  void lampDriftsWithTheShotNumber() {
    DeviceModelSettings settings;
    settings.drift = -0.1;
    SensorModel sensor(settings, 1);
    QCOMPARE(sensor.lampPower({{"x", 0}, 0, 1.0}), 1.0);
    QCOMPARE(sensor.lampPower({{"x", 500}, 0, 1.0}), 0.95);
  }

  void lampFlickers() {
    DeviceModelSettings settings;
    settings.flicker = 0.02;
    SensorModel sensor(settings, 1);
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < 2000; ++i) {
      double power = sensor.lampPower({{"x", i}, 0, 1.0});
      sum += power;
      square += power * power;
    }
    double mean = sum / 2000.0, deviation = std::sqrt(square / 2000.0 - mean * mean);
    QVERIFY(std::abs(mean - 1.0) < 4.0 * 0.02 / std::sqrt(2000.0));
    QVERIFY(std::abs(deviation / 0.02 - 1.0) < 4.0 / std::sqrt(4000.0));
  }
};

QTEST_APPLESS_MAIN(TestSimulatedDevices)
#include "test_simulated_devices.moc"
