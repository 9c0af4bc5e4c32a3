// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/base/random.h"
#include "relucent/image/colour.h"
#include "relucent/image/metrics.h"

using namespace relucent;
using namespace relucent::image;

namespace {

Image noise(Size size, std::uint64_t seed) {
  Random random{seed};
  Image image(size, 3);
  for (float& value : image.data()) value = random.uniformFloat();
  return image;
}

/// Wang et al. 2004 by its definition: one window at a time, in doubles.
double directSsim(const Image& a, const Image& b, int centreX, int centreY) {
  double weights = 0, meanA = 0, meanB = 0, squareA = 0, squareB = 0, product = 0;
  for (int dy = -5; dy <= 5; ++dy)
    for (int dx = -5; dx <= 5; ++dx) {
      const double weight = std::exp(-(dx * dx + dy * dy) / (2.0 * 1.5 * 1.5));
      auto luma = [&](const Image& image) {
        const int x = centreX + dx, y = centreY + dy;
        return luminance(Colour{image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)});
      };
      const double valueA = luma(a), valueB = luma(b);
      weights += weight;
      meanA += weight * valueA;
      meanB += weight * valueB;
      squareA += weight * valueA * valueA;
      squareB += weight * valueB * valueB;
      product += weight * valueA * valueB;
    }
  meanA /= weights;
  meanB /= weights;
  const double varianceA = squareA / weights - meanA * meanA, varianceB = squareB / weights - meanB * meanB;
  const double covariance = product / weights - meanA * meanB;
  return (2 * meanA * meanB + 1e-4) * (2 * covariance + 9e-4) /
         ((meanA * meanA + meanB * meanB + 1e-4) * (varianceA + varianceB + 9e-4));
}

}  // namespace

class TestMetrics : public QObject {
  Q_OBJECT

 private slots:
  void psnrOfAKnownError_data() {
    QTest::addColumn<float>("step");
    QTest::addColumn<double>("peak");
    QTest::addColumn<double>("decibels");
    QTest::newRow("a tenth of the peak") << 0.1f << 1.0 << 20.0;
    QTest::newRow("a hundredth") << 0.01f << 1.0 << 40.0;
    QTest::newRow("peak four") << 0.4f << 4.0 << 20.0;
    QTest::newRow("as large as the peak") << 1.0f << 1.0 << 0.0;
  }
  void psnrOfAKnownError() {
    QFETCH(float, step);
    QFETCH(double, peak);
    QFETCH(double, decibels);
    const Image black({4, 3}, 3), error({4, 3}, 3, step);
    QVERIFY(std::abs(psnr(black, error, peak) - decibels) < 1e-5);  // 0.1f is 0.1 to 1e-8
    const float white = static_cast<float>(peak);
    QVERIFY(std::abs(psnr(error, black, std::array{white, white, white}) - decibels) < 1e-5);
  }

  void psnrIsInfiniteForEqualImages() { QVERIFY(std::isinf(psnr(noise({5, 5}, 1), noise({5, 5}, 1), 1.0))); }

  void psnrDividesEachChannelByItsWhite() {
    Image a({3, 3}, 3), b({3, 3}, 3);
    for (std::size_t i = 0; i < b.pixels(); ++i) {
      b.pixel(i)[0] = 0.2f;
      b.pixel(i)[1] = 0.4f;
      b.pixel(i)[2] = 0.8f;
    }
    QVERIFY(std::abs(psnr(a, b, std::array{2.0f, 4.0f, 8.0f}) - 20.0) < 1e-5);
  }

  void theMaskDecidesWhatCounts() {
    Image a({2, 2}, 3), b = a;
    b.at(1, 1, 2) = 3.0f;
    const std::vector<std::uint8_t> without{1, 1, 1, 0}, only{0, 0, 0, 7};
    QCOMPARE(mse(a, b), 9.0 / 12.0);
    QCOMPARE(mse(a, b, without), 0.0);
    QCOMPARE(mse(a, b, only), 3.0);
    QVERIFY_THROWS_EXCEPTION(std::logic_error, mse(a, b, std::vector<std::uint8_t>{1, 1}));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, mse(a, b, std::vector<std::uint8_t>(4)));
  }

  void ssimIsOneForEqualAndSymmetric() {
    const Image a = noise({32, 24}, 1), b = noise({32, 24}, 2);
    QVERIFY(std::abs(ssim(a, a) - 1.0) < 1e-12);
    QCOMPARE(ssim(a, b), ssim(b, a));
    QVERIFY(ssim(a, b) < 0.1);  // unrelated noise has no structure in common
  }

  void ssimIsTheMeanOfTheDefinition() {
    const Image a = noise({14, 13}, 3);
    Image b = a;
    Random random{4};
    for (float& value : b.data()) value = 0.7f * value + 0.2f * random.uniformFloat();
    double sum = 0;
    for (int y = 5; y < 8; ++y)
      for (int x = 5; x < 9; ++x) sum += directSsim(a, b, x, y);
    QVERIFY(std::abs(ssim(a, b) - sum / 12.0) < 1e-9);

    std::vector<std::uint8_t> mask(a.pixels());
    mask[indexOf(a.size(), {6, 7})] = 1;
    QVERIFY(std::abs(ssim(a, b, mask) - directSsim(a, b, 6, 7)) < 1e-9);
  }

  void ssimOfFlatImagesIsTheLuminanceTerm() {
    const Image a({20, 20}, 3, 0.25f), b({20, 20}, 3, 0.5f);
    const double expected = (2 * 0.25 * 0.5 + 1e-4) / (0.25 * 0.25 + 0.5 * 0.5 + 1e-4);
    QVERIFY(std::abs(ssim(a, b) - expected) < 1e-9);
  }

  void ssimFallsWithDistortion() {
    const Image a = noise({40, 40}, 5);
    double before = 1.0;
    for (float share : {0.1f, 0.3f, 0.6f}) {
      Image b = a;
      Random random{6};
      for (float& value : b.data()) value = (1.0f - share) * value + share * random.uniformFloat();
      const double now = ssim(a, b);
      QVERIFY2(now < before, qPrintable(QString("%1 is not below %2").arg(now).arg(before)));
      before = now;
    }
  }

  void multiScaleSsimIsOneForEqualAndSymmetric() {
    const Image a = noise({100, 90}, 1), b = noise({100, 90}, 2);
    QVERIFY(std::abs(multiScaleSsim(a, a) - 1.0) < 1e-12);
    QCOMPARE(multiScaleSsim(a, b), multiScaleSsim(b, a));
    QVERIFY(multiScaleSsim(a, b) >= 0.0);
  }

  void multiScaleSsimHasAsManyScalesAsHoldAWindow_data() {
    QTest::addColumn<int>("side");
    QTest::addColumn<double>("luminanceShare");  // the coarsest scale's exponent, of all that count
    QTest::newRow("one") << 21 << 1.0;
    QTest::newRow("two") << 22 << 0.2856 / 0.3304;
    QTest::newRow("three") << 44 << 0.3001 / 0.6305;
    QTest::newRow("five") << 176 << 0.1333 / 1.0001;
    QTest::newRow("no more than five") << 400 << 0.1333 / 1.0001;
  }
  void multiScaleSsimHasAsManyScalesAsHoldAWindow() {
    QFETCH(int, side);
    QFETCH(double, luminanceShare);
    // Flat images have the same structure; what is left is the term of luminance, at the coarsest scale.
    const Image a({side, side}, 3, 0.25f), b({side, side}, 3, 0.5f);
    QVERIFY(std::abs(multiScaleSsim(a, b) - std::pow(ssim(a, b), luminanceShare)) < 1e-9);
    QVERIFY(std::abs(multiScaleSsim(noise({side, side}, 3), noise({side, side}, 3)) - 1.0) < 1e-12);
  }

  void multiScaleSsimOfOneScaleIsSsim() {
    const Image a = noise({21, 15}, 3), b = noise({21, 15}, 4);
    QVERIFY(std::abs(multiScaleSsim(a, b) - std::max(0.0, ssim(a, b))) < 1e-12);
  }

  void multiScaleSsimForgivesFineNoiseMoreThanCoarse() {
    const Image a = noise({96, 96}, 5);
    Image fine = a, coarse = a;
    for (int y = 0; y < 96; ++y)
      for (int x = 0; x < 96; ++x)
        for (int c = 0; c < 3; ++c) {
          fine.at(x, y, c) += (x + y) % 2 == 0 ? 0.1f : -0.1f;
          coarse.at(x, y, c) += (x / 8 + y / 8) % 2 == 0 ? 0.1f : -0.1f;
        }
    QVERIFY(multiScaleSsim(a, fine) > multiScaleSsim(a, coarse));
  }

  void multiScaleSsimSeesWhatTheMaskSelects() {
    const Image a = noise({64, 64}, 6);
    Image b = a;
    for (int y = 0; y < 64; ++y)
      for (int x = 40; x < 64; ++x)
        for (int c = 0; c < 3; ++c) b.at(x, y, c) = 0.0f;
    std::vector<std::uint8_t> mask(a.pixels());
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 20; ++x) mask[indexOf(a.size(), {x, y})] = 1;
    QVERIFY(std::abs(multiScaleSsim(a, b, mask) - 1.0) < 1e-12);
    QVERIFY(multiScaleSsim(a, b) < 0.99);
  }

  void ssimTakesImagesSmallerThanItsWindow() {
    const Image a = noise({4, 1}, 8);
    QVERIFY(std::abs(ssim(a, a) - 1.0) < 1e-12);
    QVERIFY(std::isfinite(ssim(a, noise({4, 1}, 9))));
    QVERIFY(std::abs(multiScaleSsim(a, a) - 1.0) < 1e-12);
  }
};

QTEST_APPLESS_MAIN(TestMetrics)
#include "test_metrics.moc"
