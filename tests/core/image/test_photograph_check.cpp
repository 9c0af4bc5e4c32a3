// SPDX-License-Identifier: MIT
#include "relucent/image/photograph_check.h"

#include <QtTest>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "relucent/base/random.h"
#include "relucent/image/resample.h"

using namespace relucent;
using namespace relucent::image;

namespace {

Image noise(Size size, std::uint64_t seed) {
  Image image(size, 3);
  Random random{seed};
  for (float& value : image.data()) value = static_cast<float>(0.05 + 0.6 * random.uniform());
  return image;
}

}  // namespace

class TestPhotographCheck : public QObject {
  Q_OBJECT

 private slots:
  void everySampleIsInOneBin_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::newRow("one pixel") << 1 << 1;
    QTest::newRow("odd") << 37 << 23;
    QTest::newRow("empty") << 0 << 0;
  }
  void everySampleIsInOneBin() {
    QFETCH(int, width);
    QFETCH(int, height);
    Image image = noise({width, height}, 3);
    PhotographCheck check = checkPhotograph(image, 0.97, 0.01);
    for (const auto& channel : check.histogram)
      QCOMPARE(std::accumulate(channel.begin(), channel.end(), std::size_t{0}), image.pixels());
    QCOMPARE(check.tooBright, 0.0);
    QCOMPARE(check.tooDark, 0.0);
  }

  void oneBrightChannelIsTooBrightAndOnlyAllDarkOnesAreTooDark() {
    Image image({4, 1}, 3, 0.5f);
    image.at(0, 0, 2) = 0.98f;
    image.at(1, 0, 0) = 0.0f;
    for (int c = 0; c < 3; ++c) image.at(2, 0, c) = 0.0f;
    for (int c = 0; c < 3; ++c) image.at(3, 0, c) = std::numeric_limits<float>::quiet_NaN();
    PhotographCheck check = checkPhotograph(image, 0.97, 0.01);
    QVERIFY(check.exposed[0] == Exposed::tooBright && check.exposed[1] == Exposed::well);
    QVERIFY(check.exposed[2] == Exposed::tooDark && check.exposed[3] == Exposed::tooDark);
    QCOMPARE(check.tooBright, 0.25);
    QCOMPARE(check.tooDark, 0.5);
  }

  void brightPixelsAreAShareOfTheRegionWithinThePhotograph_data() {
    QTest::addColumn<QRect>("area");
    QTest::addColumn<double>("share");
    QTest::newRow("bright half") << QRect(0, 0, 2, 4) << 1.0;
    QTest::newRow("both halves") << QRect(0, 0, 4, 4) << 0.5;
    QTest::newRow("dark half") << QRect(2, 1, 2, 2) << 0.0;
    QTest::newRow("over the edge") << QRect(-2, -2, 5, 5) << 2.0 / 3.0;
    QTest::newRow("outside") << QRect(9, 9, 3, 3) << 0.0;
  }
  void brightPixelsAreAShareOfTheRegionWithinThePhotograph() {
    QFETCH(QRect, area);
    Image image({4, 4}, 3, 0.5f);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 2; ++x) image.at(x, y, 1) = 1.0f;
    const PhotographCheck check = checkPhotograph(image, 0.97, 0.01);
    QTEST(tooBrightWithin(check, image.size(), {area.x(), area.y(), area.width(), area.height()}), "share");
  }

  void sharpnessDoesNotDependOnTheExposure() {
    Image image = noise({40, 30}, 5), half = image;
    for (float& value : half.data()) value *= 0.5f;
    Region all{0, 0, 40, 30};
    // Halving is exact in floating point.
    QCOMPARE(sharpness(half, all), sharpness(image, all));
  }

  void blurIsLessSharp() {
    Image image = noise({64, 48}, 7);
    Image blurred = resized(resized(image, {16, 12}), {64, 48});
    Region middle{16, 12, 32, 24};
    QVERIFY(sharpness(blurred, middle) < 0.5 * sharpness(image, middle));
  }

  /// Law: what is marked as sharp depends on the focus, not on the exposure.
  void peaksAreWhereItIsSharp() {
    const auto marked = [](const Image& image) {
      const std::vector<std::uint8_t> peaks = focusPeaks(image, 0.2, 0.0);
      return std::count(peaks.begin(), peaks.end(), std::uint8_t{1});
    };
    Image image = noise({64, 48}, 7), half = image;
    for (float& value : half.data()) value *= 0.5f;
    QVERIFY(marked(image) > 1000);
    QCOMPARE(marked(half), marked(image));
    QVERIFY(marked(resized(resized(image, {8, 6}), {64, 48})) < marked(image) / 4);
    QCOMPARE(marked(Image({8, 8}, 3, 0.4f)), 0);
    QCOMPARE(marked(Image({1, 1}, 3, 0.4f)), 0);
    const std::vector<std::uint8_t> dark = focusPeaks(half, 0.2, 1.0);
    QCOMPARE(std::count(dark.begin(), dark.end(), std::uint8_t{1}), 0);
  }

  void thereIsNothingSharpInNothing_data() {
    QTest::addColumn<int>("side");
    QTest::addColumn<int>("at");
    QTest::newRow("outside") << 8 << 100;
    QTest::newRow("one pixel") << 1 << 0;
    QTest::newRow("no pixel") << 0 << 0;
    QTest::newRow("even light") << 8 << 0;
  }
  void thereIsNothingSharpInNothing() {
    QFETCH(int, side);
    QFETCH(int, at);
    QCOMPARE(sharpness(Image({8, 8}, 3, 0.4f), {at, at, side, side}), 0.0);
    QCOMPARE(sharpness(Image({8, 8}, 3, 0.0f), {at, at, side, side}), 0.0);
  }
};

QTEST_GUILESS_MAIN(TestPhotographCheck)
#include "test_photograph_check.moc"
