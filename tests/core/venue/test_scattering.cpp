// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>

#include "relucent/base/random.h"
#include "relucent/venue/sample_pattern.h"
#include "relucent/venue/scattering.h"

using namespace relucent;
using namespace relucent::transport;
using namespace relucent::venue;
using Eigen::Vector2f;
using Eigen::Vector3f;

namespace {

Vector3f slanted(float degrees, float turn = 0.0f) {
  float angle = degrees / 180.0f * std::numbers::pi_v<float>;
  return {std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle)};
}

ScatteringPoint surface(float reflectance, float gloss, float exponent, const Vector3f& outgoing) {
  return {Vector3f::UnitZ(), Vector3f::UnitZ(), outgoing, Spectrum::Constant(reflectance), gloss, exponent};
}

float meanWeight(const ScatteringPoint& point) {
  SamplePattern samples(4096, 7);
  float sum = 0.0f;
  for (int i = 0; i < samples.count(); ++i)
    sum +=
        sampleBounce(point, samples.point(i, 0, Vector2f::Zero()), samples.point(i, 1, Vector2f::Zero()).x())
            .weight.mean();
  return sum / static_cast<float>(samples.count());
}

}  // namespace

class TestScattering : public QObject {
  Q_OBJECT
 private slots:
  void whiteFurnace_data() {
    QTest::addColumn<float>("gloss");
    QTest::addColumn<float>("exponent");
    QTest::addColumn<float>("degrees");
    for (float degrees : {0.0f, 40.0f, 80.0f}) {
      QTest::addRow("diffuse, %g degrees", static_cast<double>(degrees)) << 0.0f << 1.0f << degrees;
      QTest::addRow("some gloss, %g degrees", static_cast<double>(degrees)) << 0.1f << 40.0f << degrees;
      QTest::addRow("all gloss, %g degrees", static_cast<double>(degrees)) << 1.0f << 200.0f << degrees;
    }
  }
  /// Under light of 1 from everywhere a white diffuse surface shows 1, a glossy one at most that.
  void whiteFurnace() {
    QFETCH(float, gloss);
    QFETCH(float, exponent);
    QFETCH(float, degrees);
    float seen = meanWeight(surface(1.0f, gloss, exponent, slanted(degrees)));
    // 4096 well-spread samples; what a lobe loses below the horizon is lost.
    QVERIFY2(seen <= 1.005f, qPrintable(QString("%1").arg(static_cast<double>(seen))));
    if (gloss == 0.0f)
      QVERIFY2(std::abs(seen - 1.0f) < 1e-5f, qPrintable(QString("%1").arg(static_cast<double>(seen))));
    if (degrees == 0.0f) QVERIFY2(seen > 0.97f, qPrintable(QString("%1").arg(static_cast<double>(seen))));
  }

  void brdfIsReciprocal() {
    Random random({3});
    for (int i = 0; i < 100; ++i) {
      Vector3f a = slanted(85.0f * random.uniformFloat(), 6.28f * random.uniformFloat());
      Vector3f b = slanted(85.0f * random.uniformFloat(), 6.28f * random.uniformFloat());
      float there = surface(0.5f, 0.2f, 30.0f, a).brdf(b)[0], back = surface(0.5f, 0.2f, 30.0f, b).brdf(a)[0];
      // The exponent multiplies the rounding of the cosine.
      QVERIFY2(std::abs(there - back) <= 1e-4f * there, "brdf changes when light is reversed");
    }
  }

  void glassRefractsBySnell() {
    Vector3f in = -slanted(35.0f);
    Vector3f out = throughGlass(in, Vector3f::UnitZ(), 1.5f, 0.999f);
    float sineIn = in.cross(Vector3f::UnitZ()).norm(), sineOut = out.cross(Vector3f::UnitZ()).norm();
    QVERIFY(out.z() < 0.0f);
    QVERIFY(std::abs(sineIn - 1.5f * sineOut) < 1e-6f);
    QVERIFY((throughGlass(-out, Vector3f::UnitZ(), 1.5f, 0.999f) + in).norm() < 1e-5f);
  }

  void glassReflectsByFresnel() {
    // At normal incidence ((n - 1) / (n + 1))^2 = 0.04 of the choices are reflections, from both sides.
    for (float side : {-1.0f, 1.0f}) {
      Vector3f direction = side * Vector3f::UnitZ();
      QVERIFY(throughGlass(direction, Vector3f::UnitZ(), 1.5f, 0.0399f).dot(direction) < -0.999f);
      QVERIFY(throughGlass(direction, Vector3f::UnitZ(), 1.5f, 0.0401f).dot(direction) > 0.999f);
    }
    // Beyond the critical angle, 41.8 degrees, everything is reflected inside.
    Vector3f steep = slanted(43.0f);
    QVERIFY(throughGlass(steep, Vector3f::UnitZ(), 1.5f, 0.999f).z() < 0.0f);
  }

  void reflectancesArePlausible() {
    for (float r : {0.0f, 0.3f, 1.0f})
      for (float g : {0.0f, 0.5f, 1.0f})
        for (float b : {0.0f, 0.7f, 1.0f}) {
          Spectrum spectrum = reflectance({r, g, b});
          QVERIFY(spectrum.minCoeff() >= -1e-6f && spectrum.maxCoeff() <= 1.0f + 1e-6f);
        }
  }

  /// A white surface under the projector's white looks white; its colours mix differently on another surface.
  void cameraIsWhiteBalanced() {
    ColourBlock white = colourBlock(Spectrum::Ones());
    Eigen::Vector3f seen = white.rowwise().sum();
    QVERIFY((seen - Eigen::Vector3f::Ones()).norm() < 1e-5f);
    ColourBlock red = colourBlock(reflectance({0.7f, 0.2f, 0.1f}));
    Eigen::Matrix3f ratio = red.cwiseQuotient(white);
    QVERIFY(ratio.maxCoeff() > 2.0f * ratio.minCoeff());
  }
};

QTEST_APPLESS_MAIN(TestScattering)
#include "test_scattering.moc"
