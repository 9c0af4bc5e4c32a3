// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>
#include <functional>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/hdr/isotonic.h"
#include "relucent/hdr/response_curve.h"

using namespace relucent;
using namespace relucent::hdr;

namespace {

using Values = std::vector<double>;

Values ramp(int samples, double power = 1.0) {
  Values x;
  for (int i = 0; i < samples; ++i) x.push_back(std::pow(static_cast<double>(i) / (samples - 1), power));
  return x;
}

/// Ascending random samples with steps between 1 and 1e6 to 1: the hard case for a cubic.
ResponseCurve roughCurve(std::uint64_t seed) {
  Random random{seed};
  int samples = 2 + static_cast<int>(random.below(40));
  Values x{0.0}, y{0.0};
  for (int i = 1; i < samples; ++i) {
    x.push_back(x.back() + 0.01 + random.uniform());
    y.push_back(y.back() + std::pow(10.0, -6.0 * random.uniform()));
  }
  double lastX = x.back(), lastY = y.back();
  for (double& value : x) value /= lastX;
  for (double& value : y) value /= lastY;
  x.back() = y.back() = 1.0;
  return ResponseCurve(x, y);
}

double squares(const Values& a, const Values& b, const Values& weights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += weights[i] * (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

}  // namespace

class TestResponseCurve : public QObject {
  Q_OBJECT

 private slots:
  void identityIsExact() {
    ResponseCurve curve;
    QVERIFY(curve.isIdentity());
    for (double x : {-0.1, 0.0, 0.3, 1.0, 1.2}) QCOMPARE(curve(x), x);
    QCOMPARE(curve.inverse(0.3), 0.3);
    QVERIFY(!ResponseCurve({0.0, 0.5, 1.0}, {0.0, 0.4, 1.0}).isIdentity());
  }

  void curvesPassTheirSamplesAscendAndInvert_data() {
    QTest::addColumn<quint64>("seed");
    for (quint64 seed = 1; seed <= 20; ++seed) QTest::addRow("seed %llu", seed) << seed;
  }
  void curvesPassTheirSamplesAscendAndInvert() {
    QFETCH(quint64, seed);
    ResponseCurve curve = roughCurve(seed);
    for (std::size_t i = 0; i < curve.x().size(); ++i)
      QVERIFY(std::abs(curve(curve.x()[i]) - curve.y()[i]) < 1e-14);

    double before = curve(-0.01);
    for (int i = 0; i <= 5000; ++i) {
      double x = i / 5000.0, y = curve(x);
      QVERIFY2(y >= before - 1e-15, qPrintable(QString("falls at %1").arg(x)));
      QVERIFY(curve.slope(x) >= -1e-12);
      before = y;
      // The inverse lands on the same light; where the slope allows it, on the same drive.
      double back = curve.inverse(y);
      QVERIFY(std::abs(curve(back) - y) < 1e-12);
      if (curve.slope(x) > 1e-3) QVERIFY(std::abs(back - x) < 1e-9);
    }
    QCOMPARE(curve.inverse(-1.0), 0.0);
    QCOMPARE(curve.inverse(2.0), 1.0);
    QCOMPARE(ResponseCurve(curve.x(), curve.y()), curve);
  }

  void smoothCurvesAreFollowed_data() {
    QTest::addColumn<double>("gamma");
    for (double gamma : {1.0, 1.8, 2.2, 2.6}) QTest::addRow("gamma %.1f", gamma) << gamma;
  }
  void smoothCurvesAreFollowed() {
    QFETCH(double, gamma);
    Values x = ramp(33, 2.0), y;
    for (double drive : x) y.push_back(std::pow(drive, gamma));
    ResponseCurve curve(x, y);
    // Cubic interpolation: error of order h^4 f'''' / 384 inside, of order h^3 at the ends; h <= 1/16.
    for (int i = 0; i <= 1000; ++i) QVERIFY(std::abs(curve(i / 1000.0) - std::pow(i / 1000.0, gamma)) < 2e-4);
  }

  void slopeIsTheDerivative() {
    ResponseCurve curve = roughCurve(3);
    for (int i = 1; i < 200; ++i) {
      double x = i / 200.0, h = 1e-6;
      QVERIFY(std::abs(curve.slope(x) - (curve(x + h) - curve(x - h)) / (2 * h)) <
              1e-3 * (1.0 + std::abs(curve.slope(x))));
    }
  }

  void badSamplesAreRefused_data() {
    QTest::addColumn<QList<double>>("x");
    QTest::addColumn<QList<double>>("y");
    double nan = std::nan("");
    QTest::newRow("equal values") << QList<double>{0, 0.5, 1} << QList<double>{0, 0, 1};
    QTest::newRow("falling") << QList<double>{0, 0.5, 1} << QList<double>{0, 1.1, 1};
    QTest::newRow("drive falls") << QList<double>{0, 0.7, 0.6, 1} << QList<double>{0, 0.1, 0.2, 1};
    QTest::newRow("not from 0") << QList<double>{0.1, 1} << QList<double>{0, 1};
    QTest::newRow("not to 1") << QList<double>{0, 0.9} << QList<double>{0, 1};
    QTest::newRow("one sample") << QList<double>{0} << QList<double>{0};
    QTest::newRow("sizes differ") << QList<double>{0, 1} << QList<double>{0, 0.5, 1};
    QTest::newRow("not a number") << QList<double>{0, 0.5, 1} << QList<double>{0, nan, 1};
  }
  void badSamplesAreRefused() {
    QFETCH(QList<double>, x);
    QFETCH(QList<double>, y);
    QVERIFY_EXCEPTION_THROWN(ResponseCurve(Values(x.begin(), x.end()), Values(y.begin(), y.end())), Error);
  }

  void isotonicAscendsIsIdempotentAndClosest_data() {
    QTest::addColumn<quint64>("seed");
    for (quint64 seed = 1; seed <= 10; ++seed) QTest::addRow("seed %llu", seed) << seed;
  }
  void isotonicAscendsIsIdempotentAndClosest() {
    QFETCH(quint64, seed);
    Random random{seed};
    Values values, weights;
    for (int i = 0; i < 60; ++i) {
      values.push_back(0.02 * i + random.normal());
      weights.push_back(0.1 + random.uniform());
    }
    Values fitted = isotonic(values, weights);
    QVERIFY(std::is_sorted(fitted.begin(), fitted.end()));
    QCOMPARE(isotonic(fitted, weights), fitted);

    // The projection onto a convex cone: no other ascending sequence is closer, and the weighted mean stays.
    double sum = 0.0, fittedSum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum += weights[i] * values[i];
      fittedSum += weights[i] * fitted[i];
    }
    QVERIFY(std::abs(sum - fittedSum) < 1e-10);
    for (int trial = 0; trial < 200; ++trial) {
      Values other = fitted;
      for (double& value : other) value += 0.05 * random.normal();
      std::sort(other.begin(), other.end());
      QVERIFY(squares(other, values, weights) >= squares(fitted, values, weights) - 1e-12);
    }
  }

  void isotonicLeavesAscendingValuesAlone() {
    Values values{-1.0, 0.0, 0.0, 0.5, 2.0};
    QCOMPARE(isotonic(values, Values(5, 0.3)), values);
    QCOMPARE(isotonic({3.0, 1.0, 2.0}, {1.0, 1.0, 1.0}), (Values{2.0, 2.0, 2.0}));
  }

  void rampsBecomeCurves_data() {
    QTest::addColumn<double>("noise");
    QTest::addColumn<double>("crushed");
    QTest::addColumn<double>("clipped");
    QTest::newRow("clean") << 0.0 << 0.0 << 1.0;
    QTest::newRow("noisy") << 0.004 << 0.0 << 1.0;
    QTest::newRow("crushed shadows") << 0.0 << 0.2 << 1.0;
    QTest::newRow("clipped lights") << 0.0 << 0.0 << 0.85;
    QTest::newRow("all of it") << 0.004 << 0.15 << 0.9;
  }
  void rampsBecomeCurves() {
    QFETCH(double, noise);
    QFETCH(double, crushed);
    QFETCH(double, clipped);
    auto truth = [&](double drive) {
      return std::pow(std::clamp((drive - crushed) / (clipped - crushed), 0.0, 1.0), 2.2);
    };
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Random random{seed};
      Values x = ramp(49, 1.5), y;
      for (double drive : x) y.push_back(7.0 + 3.0 * (truth(drive) + noise * random.normal()));
      ResponseCurve curve = curveFromRamp(x, y, Values(x.size(), 1.0));
      QCOMPARE(curve(0.0), 0.0);
      QCOMPARE(curve(1.0), 1.0);
      // Isotonic regression is no further off than the largest single error (4 sigma over 49 samples, and the
      // same at both ends through the normalisation). A kink of slope 2.6 between levels h = 0.031 apart is
      // missed by up to slope * h / 8 = 0.01; smooth curves by less than 0.003.
      double kink = clipped < 1.0 ? 0.01 : 0.003;
      for (int i = 0; i <= 500; ++i)
        QVERIFY2(std::abs(curve(i / 500.0) - truth(i / 500.0)) < 8.0 * noise + kink,
                 qPrintable(QString("seed %1 at %2: %3 for %4")
                                .arg(seed)
                                .arg(i / 500.0)
                                .arg(curve(i / 500.0))
                                .arg(truth(i / 500.0))));
    }
  }

  void plateausCanBeInverted() {
    ResponseCurve curve = curveFromRamp({0, 0.2, 0.4, 0.6, 0.8, 1}, {0, 0, 0, 1, 2, 2}, Values(6, 1.0));
    QVERIFY(curve.inverse(1e-4) > 0.39);
    QVERIFY(curve.inverse(1.0 - 1e-4) < 0.81);
    QVERIFY(curve(0.4) < 1e-5);
  }

  void flatRampsAreRefused() {
    QVERIFY_EXCEPTION_THROWN(curveFromRamp({0, 0.5, 1}, {1, 1, 1}, Values(3, 1.0)), Error);
    QVERIFY_EXCEPTION_THROWN(curveFromRamp({0, 0.5, 1}, {3, 2, 1}, Values(3, 1.0)), Error);
  }
};

QTEST_APPLESS_MAIN(TestResponseCurve)
#include "test_response_curve.moc"
