// SPDX-License-Identifier: MIT
// What photographs of a picture teach about it, and how it becomes better by them.
#include "relucent/compensation/perfecting.h"

#include <QtTest>
#include <cmath>

#include "core/inverse/synthetic_transport.h"
#include "relucent/inverse/windows.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::hdr;
using namespace relucent::image;
using namespace relucent::inverse;
using namespace relucent::synthetic;

namespace {

Progress quiet;

MeasuredVenue venueOf(std::uint64_t seed) {
  SceneSettings settings;
  settings.seed = seed;
  Scene scene = makeScene(settings);
  const CameraStack flood = scene.transport.floodlight();
  return {std::move(scene.transport), std::move(scene.black), flood, std::move(scene.usable)};
}

Image pictureOf(std::uint64_t seed) {
  Image picture({48, 36}, 3);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      for (int c = 0; c < 3; ++c)
        picture.at(x, y, c) =
            static_cast<float>(cloud(x, y, 3 * seed + static_cast<std::uint64_t>(c), 4, 16.0));
  return picture;
}

/// A photograph of light, with noise of this standard deviation relative to the brightest flood.
HdrFrame photographOf(CameraStack light, const MeasuredVenue& venue, double noise, std::uint64_t seed) {
  const double deviation = noise * *std::max_element(venue.flood.begin(), venue.flood.end());
  HdrFrame frame;
  frame.variance.assign(light.size(), static_cast<float>(deviation * deviation));
  frame.valid.assign(light.size(), 1);
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] += static_cast<float>(deviation * Random({seed, i}).normal());
  frame.radiance = std::move(light);
  return frame;
}

/// The venue as it is: every camera pixel gives `wrong` more or less than T has it, in smooth patches.
CameraStack asItIs(CameraStack light, const MeasuredVenue& venue, double wrong) {
  const Size view = venue.transport.cameras().size(0);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Pixel at = pixelAt(view, i / 3);
    light[i] *= static_cast<float>(1.0 + wrong * 2.0 * (cloud(at.x, at.y, 5, 2, 8.0) - 0.5));
  }
  return light;
}

}  // namespace

class TestPerfecting : public QObject {
  Q_OBJECT
 private slots:
  void learnsAllWithoutNoise_data() {
    QTest::addColumn<int>("seed");
    QTest::addColumn<double>("wrong");
    for (int seed : {1, 2})
      for (double wrong : {0.02, 0.3}) QTest::addRow("seed %d, wrong by %g", seed, wrong) << seed << wrong;
  }
  void learnsAllWithoutNoise() {
    QFETCH(int, seed);
    QFETCH(double, wrong);
    const MeasuredVenue venue = venueOf(static_cast<std::uint64_t>(seed));
    const ProjectorStack drive(3 * venue.transport.projectors().count(), 0.5f);
    const CameraStack predicted = venue.transport.apply(drive);
    const CameraStack is = asItIs(predicted, venue, wrong);
    Unexplained unexplained(venue);
    unexplained.learn(photographOf(is, venue, 0.0, 1), predicted);
    // Of a few values alone, far below the others, nothing is told.
    const float dim = *std::max_element(predicted.begin(), predicted.end()) / 32.0f;
    for (std::size_t i = 0; i < is.size(); ++i)
      // Floats: the difference of two of this size.
      QVERIFY(predicted[i] < dim || std::abs(unexplained.value()[i] - (is[i] - predicted[i])) <=
                                        1e-6f * std::max(is[i], predicted[i]));
    QVERIFY(unexplained.relative() > 0.2 * wrong && unexplained.relative() < wrong);
  }

  void noiseTeachesNothing_data() {
    QTest::addColumn<int>("seed");
    for (int seed : {1, 2, 3}) QTest::addRow("seed %d", seed) << seed;
  }
  /// Where T is right b is what noise alone says, and that is hardly believed.
  void noiseTeachesNothing() {
    QFETCH(int, seed);
    const MeasuredVenue venue = venueOf(static_cast<std::uint64_t>(seed));
    const CameraStack predicted =
        venue.transport.apply(ProjectorStack(3 * venue.transport.projectors().count(), 0.5f));
    const HdrFrame frame = photographOf(predicted, venue, 0.01, static_cast<std::uint64_t>(seed));
    Unexplained unexplained(venue);
    unexplained.learn(frame, predicted);
    double learned = 0.0, noise = 0.0;
    for (std::size_t i = 0; i < predicted.size(); ++i) {
      learned += std::pow(static_cast<double>(unexplained.value()[i]), 2);
      noise += static_cast<double>(frame.variance[i]);
    }
    // t^2 is found to within the deviation of the mean of so many squares: some per cent of the variance.
    QVERIFY2(learned < 0.01 * noise, qPrintable(QString::number(learned / noise)));
  }

  /// What is not valid teaches nothing, and what was learned before stays.
  void believesNoSaturatedPixel() {
    const MeasuredVenue venue = venueOf(1);
    const CameraStack predicted =
        venue.transport.apply(ProjectorStack(3 * venue.transport.projectors().count(), 0.5f));
    HdrFrame frame = photographOf(asItIs(predicted, venue, 0.2), venue, 0.0, 1);
    Unexplained unexplained(venue);
    unexplained.learn(frame, predicted);
    const CameraStack before = unexplained.value();
    for (std::size_t i = 0; i < frame.valid.size(); i += 2) {
      frame.valid[i] = 0;
      frame.radiance[i] = 1e6f;
    }
    unexplained.learn(frame, predicted);
    for (std::size_t i = 0; i < before.size(); i += 2) QCOMPARE(unexplained.value()[i], before[i]);
  }

  /// Of a picture as it is asked for, noise gives 0 on the average, and scatters as it says.
  void weighsErrorsWithoutNoise() {
    const MeasuredVenue venue = venueOf(1);
    const Target target = fitTarget(pictureOf(1), venue, {});
    constexpr int tries = 40;
    double sum = 0.0, squares = 0.0, deviation = 0.0;
    for (int seed = 0; seed < tries; ++seed) {
      const WeighedError error = weighedError(
          photographOf(target.asked, venue, 0.01, 100 + static_cast<std::uint64_t>(seed)), target);
      sum += error.value;
      squares += error.value * error.value;
      deviation += error.deviation / tries;
    }
    const double mean = sum / tries, scatter = std::sqrt(squares / tries - mean * mean);
    // The mean of 40: four of its deviations. The scatter of 40 is known to 11 %; again four of them.
    QVERIFY2(std::abs(mean) < 4.0 * deviation / std::sqrt(tries),
             qPrintable(QString::number(mean / deviation)));
    QVERIFY2(std::abs(scatter / deviation - 1.0) < 0.45, qPrintable(QString::number(scatter / deviation)));
  }

  void picturesBecomeBetter_data() {
    QTest::addColumn<int>("seed");
    QTest::addColumn<double>("wrong");
    QTest::addColumn<double>("noise");
    QTest::addColumn<double>("left");  // of the squared error that T's being wrong has caused, at most
    for (int seed : {1, 2, 3}) {
      QTest::addRow("seed %d, 10 %%", seed) << seed << 0.1 << 0.0 << 0.1;
      QTest::addRow("seed %d, 30 %%", seed) << seed << 0.3 << 0.0 << 0.2;
      QTest::addRow("seed %d, 10 %%, noise", seed) << seed << 0.1 << 1e-3 << 0.3;
    }
  }
  /// Three photographs take back most of what was lost against a T that is right.
  void picturesBecomeBetter() {
    QFETCH(int, seed);
    QFETCH(double, wrong);
    QFETCH(double, noise);
    QFETCH(double, left);
    const MeasuredVenue venue = venueOf(static_cast<std::uint64_t>(seed));
    const WindowInverse inverse = computeWindows(venue.transport, venue.usable, {}, quiet);
    const Compensator compensator(venue, inverse);
    TargetSettings settings;
    settings.reachablePercentile = 2.0;
    const Target target = fitTarget(pictureOf(static_cast<std::uint64_t>(seed)), venue, settings);
    const auto errorOf = [&](CameraStack light) {
      return weighedError(photographOf(std::move(light), venue, 0.0, 1), target).value;
    };
    Compensation p = compensator.goOn(target, compensator.solve(Method::refined, target, quiet), 3, quiet);
    const double right = errorOf(venue.transport.apply(p.projector));
    const double before = errorOf(asItIs(venue.transport.apply(p.projector), venue, wrong)) - right;
    Unexplained unexplained(venue);
    for (std::uint64_t photograph = 0; photograph < 3; ++photograph) {
      const CameraStack predicted = venue.transport.apply(p.projector);
      unexplained.learn(photographOf(asItIs(predicted, venue, wrong), venue, noise, photograph), predicted);
      p = solvedAgain(compensator, target, unexplained.value(), std::move(p), 2, quiet);
    }
    const double after = errorOf(asItIs(venue.transport.apply(p.projector), venue, wrong)) - right;
    QVERIFY(before > 0.0);
    QVERIFY2(after < left * before, qPrintable(QString::number(after / before)));
  }
};

QTEST_GUILESS_MAIN(TestPerfecting)
#include "test_perfecting.moc"
