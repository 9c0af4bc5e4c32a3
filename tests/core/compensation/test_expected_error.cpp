// SPDX-License-Identifier: MIT
#include "relucent/compensation/expected_error.h"

#include <QtTest>
#include <algorithm>
#include <cmath>

#include "core/inverse/synthetic_transport.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::synthetic;

namespace {

TransportVariance noVariance(const Scene& scene) {
  const CameraStack none(3 * scene.transport.cameras().count(), 0.0f);
  return {none, none, none};
}

ProjectorStack flat(const Scene& scene, float value) {
  return ProjectorStack(3 * scene.transport.projectors().count(), value);
}

/// Black and white, a pixel each.
ProjectorStack checks(const Scene& scene) {
  const Size size = scene.transport.projectors().size(0);
  ProjectorStack pattern = flat(scene, 0.0f);
  for (std::size_t j = 0; j < pattern.size(); ++j) {
    const int pixel = static_cast<int>(j / 3);
    pattern[j] = static_cast<float>((pixel % size.width + pixel / size.width) % 2);
  }
  return pattern;
}

/// Relative; the sums are of single precision.
bool isNear(float is, float wanted) {
  return std::abs(is - wanted) <= 1e-3f * std::abs(wanted) + 1e-9f;
}

}  // namespace

class TestExpectedError : public QObject {
  Q_OBJECT

 private slots:
  /// An even picture asks nothing of how light is divided among leaves.
  void evenPictureHasTheErrorsOfBlackAndFlood_data() {
    QTest::addColumn<float>("grey");
    QTest::addColumn<float>("black");
    QTest::addColumn<float>("flood");
    QTest::newRow("known exactly") << 0.5f << 0.0f << 0.0f;
    QTest::newRow("black") << 0.0f << 4e-4f << 1e-4f;
    QTest::newRow("grey") << 0.5f << 4e-4f << 1e-4f;
    QTest::newRow("white") << 1.0f << 4e-4f << 1e-4f;
  }
  void evenPictureHasTheErrorsOfBlackAndFlood() {
    QFETCH(float, grey);
    QFETCH(float, black);
    QFETCH(float, flood);
    const Scene scene = makeScene({});
    TransportVariance variance = noVariance(scene);
    std::ranges::fill(variance.black, black);
    std::ranges::fill(variance.flood, flood);
    std::ranges::fill(variance.leaf, 1.0f);
    const CameraStack deviation = expectedDeviation(scene.transport, variance, flat(scene, grey));
    const CameraStack light = scene.transport.floodlight();
    for (std::size_t i = 0; i < deviation.size(); ++i) {
      if (!(light[i] > 1e-3f)) continue;  // no light, no share of it
      const float expected = std::sqrt(0.88f * black + 0.71f * grey * grey * flood);
      // What a mean of equal values differs by from them, times a leaf's deviation of 1.
      QVERIFY2(std::abs(deviation[i] - expected) < 1e-5f,
               qPrintable(QString("%1, %2").arg(deviation[i]).arg(expected)));
    }
  }

  /// Without e, errors are a share of the light.
  void errorsGoWithTheLight() {
    const Scene scene = makeScene({});
    TransportVariance variance = noVariance(scene);
    std::ranges::fill(variance.flood, 1e-4f);
    std::ranges::fill(variance.leaf, 1e-4f);
    ProjectorStack picture = checks(scene);
    const CameraStack whole = expectedDeviation(scene.transport, variance, picture);
    for (float& value : picture) value *= 0.25f;
    const CameraStack part = expectedDeviation(scene.transport, variance, picture);
    for (std::size_t i = 0; i < whole.size(); ++i) QVERIFY(isNear(part[i], 0.25f * whole[i]));
  }

  /// The same light in all is better known than what every leaf has of it.
  void detailCostsMoreThanEvenLight() {
    const Scene scene = makeScene({});
    TransportVariance variance = noVariance(scene);
    std::ranges::fill(variance.flood, 1e-6f);
    std::ranges::fill(variance.leaf, 1e-6f);
    const CameraStack even = expectedDeviation(scene.transport, variance, flat(scene, 0.5f)),
                      detailed = expectedDeviation(scene.transport, variance, checks(scene));
    std::size_t lit = 0;
    for (std::size_t i = 0; i < even.size(); ++i) {
      if (scene.usable[i / 3] == 0) continue;
      ++lit;
      QVERIFY(detailed[i] > even[i]);
    }
    QVERIFY(lit > 100);
  }

  /// Of white where the pixel is, over the content alone; views apart and together.
  void sharesAreOfTheWhiteThereIs() {
    const Scene scene = makeScene({});
    const MeasuredVenue venue{scene.transport, scene.black, scene.transport.floodlight(), scene.usable};
    TransportVariance variance = noVariance(scene);
    std::ranges::fill(variance.black, 4e-4f);
    std::ranges::fill(variance.leaf, 1e-4f);
    Target target = fitTarget(image::Image({40, 30}, 3, 1.0f), venue, {});
    const ProjectorStack picture = checks(scene);
    const ExpectedError once = expectedError(venue, variance, target, picture);
    QVERIFY(once.isKnown());
    const CameraStack deviation = expectedDeviation(scene.transport, variance, picture);
    double squares = 0.0, values = 0.0;
    for (std::size_t i = 0; i < deviation.size(); ++i) {
      QVERIFY(isNear(once.radiance[i], within95 * deviation[i]));
      QCOMPARE(std::isnan(once.shareOfWhite[i / 3]), target.inside[i / 3] == 0);
      if (target.inside[i / 3] == 0) continue;
      squares += std::pow(static_cast<double>(once.radiance[i] / target.white[i % 3]), 2);
      values += 1.0;
    }
    const double expected = std::sqrt(squares / values);
    QVERIFY(std::abs(once.shareOverall() / expected - 1.0) < 1e-4);
    QCOMPARE(once.shareIn(0, venue.transport.cameras()), once.shareOverall());  // there is one view
    target.gain.assign(target.inside.size(), 2.0f);
    const ExpectedError brighter = expectedError(venue, variance, target, picture);
    QVERIFY(std::abs(2.0 * brighter.shareOverall() / once.shareOverall() - 1.0) < 1e-5);
    QVERIFY(!expectedError(venue, {variance.black, variance.flood, {}}, target, picture).isKnown());
  }

  void noisierRowsHaveLargerErrors() {
    const Scene scene = makeScene({});
    TransportVariance variance = noVariance(scene);
    const CameraStack known = expectedDeviation(scene.transport, variance, checks(scene));
    std::ranges::fill(variance.leaf, 1e-4f);
    const CameraStack noisy = expectedDeviation(scene.transport, variance, checks(scene));
    for (std::size_t i = 0; i < known.size(); ++i) {
      QVERIFY(std::isfinite(noisy[i]));
      QVERIFY(scene.usable[i / 3] == 0 || noisy[i] > known[i]);
    }
  }
};

QTEST_APPLESS_MAIN(TestExpectedError)
#include "test_expected_error.moc"
