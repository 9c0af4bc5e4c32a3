// SPDX-License-Identifier: MIT
#include <QtTest>
#include <numeric>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/image/resample.h"

using namespace relucent;
using namespace relucent::image;

namespace {

constexpr Homography identity{1, 0, 0, 0, 1, 0, 0, 0, 1};

Image noise(Size size, int channels, std::uint64_t seed) {
  Random random{seed};
  Image image(size, channels);
  for (float& value : image.data()) value = random.uniformFloat();
  return image;
}

double meanOf(const Image& image) {
  return std::accumulate(image.data().begin(), image.data().end(), 0.0) /
         static_cast<double>(image.data().size());
}

double largestDifference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.data().size(); ++i)
    largest =
        std::max(largest, std::abs(static_cast<double>(a.data()[i]) - static_cast<double>(b.data()[i])));
  return largest;
}

/// value = x + 10 y at the pixel's centre: linear, so bilinear interpolation is exact inside.
Image ramp(Size size) {
  Image image(size, 1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) image.at(x, y, 0) = static_cast<float>(x + 0.5 + 10.0 * (y + 0.5));
  return image;
}

}  // namespace

class TestResample : public QObject {
  Q_OBJECT

 private slots:
  void theSameSizeIsTheSameImage() {
    const Image image = noise({13, 7}, 3, 1);
    QCOMPARE(resized(image, image.size()), image);
  }

  void aFlatImageStaysFlat_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::newRow("smaller") << 5 << 3;
    QTest::newRow("larger") << 50 << 41;
    QTest::newRow("wider and lower") << 50 << 3;
    QTest::newRow("one pixel") << 1 << 1;
  }
  void aFlatImageStaysFlat() {
    QFETCH(int, width);
    QFETCH(int, height);
    const Image flat = resized(Image({20, 16}, 3, 0.375f), {width, height});
    QCOMPARE(flat.size(), (Size{width, height}));
    QVERIFY(largestDifference(flat, Image({width, height}, 3, 0.375f)) < 1e-6);
  }

  void shrinkingByWholeFactorsKeepsTheMean() {
    const Image image = noise({24, 18}, 3, 2);
    QVERIFY(std::abs(meanOf(resized(image, {8, 6})) - meanOf(image)) < 1e-6);
    Image block({2, 2}, 1, std::vector<float>{1, 2, 3, 6});
    QCOMPARE(resized(block, {1, 1}).at(0, 0, 0), 3.0f);
  }

  void theIdentityWarpsToTheSameImage() {
    const Image image = noise({9, 6}, 3, 3);
    QCOMPARE(warpedPerspective(image, identity, image.size()), image);
  }

  void aShiftByWholePixelsMovesThem() {
    const Image image = noise({6, 5}, 3, 4);
    const Image moved = warpedPerspective(image, {1, 0, -2, 0, 1, -1, 0, 0, 1}, {9, 7}, -1.0f);
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 9; ++x) {
        const bool inside = x >= 2 && y >= 1 && x < 8 && y < 6;
        QCOMPARE(moved.at(x, y, 1), inside ? image.at(x - 2, y - 1, 1) : -1.0f);
      }
  }

  void aLinearRampIsInterpolatedExactly() {
    const Image image = ramp({20, 20});
    const Homography sourceFromResult{0.7, 0.2, 3.0, -0.1, 0.8, 4.0, 0.0, 0.0, 1.0};
    const Image result = warpedPerspective(image, sourceFromResult, {8, 8});
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const Point at = mapped(sourceFromResult, {x + 0.5, y + 0.5});
        QVERIFY(std::abs(result.at(x, y, 0) - (at[0] + 10.0 * at[1])) < 1e-4);  // floats of about 200
      }
  }

  void shrinkingWarpsAverage() {
    // One pixel in four is lit, on a grid that point sampling would miss or hit altogether.
    Image dots({32, 32}, 1);
    for (int y = 0; y < 32; y += 2)
      for (int x = 0; x < 32; x += 2) dots.at(x, y, 0) = 1.0f;
    const Image small = warpedPerspective(dots, {4, 0, 0, 0, 4, 0, 0, 0, 1}, {8, 8});
    QVERIFY(largestDifference(small, Image({8, 8}, 1, 0.25f)) < 1e-6);
  }

  void cornersGoWhereTheyAreSent() {
    const std::array<Point, 4> corners{{{10, 12}, {90, 5}, {80, 70}, {15, 60}}};
    const Homography map = homographyFromCorners({64, 48}, corners);
    const std::array<Point, 4> own{{{0, 0}, {64, 0}, {64, 48}, {0, 48}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const Point there = mapped(map, own[i]), back = mapped(inverted(map), corners[i]);
      QVERIFY(std::hypot(there[0] - corners[i][0], there[1] - corners[i][1]) < 1e-6);
      QVERIFY(std::hypot(back[0] - own[i][0], back[1] - own[i][1]) < 1e-6);
    }
  }

  void nothingAppearsBehindTheHorizon() {
    // w = 1 - x / 8 vanishes along x = 8. Beyond it, u / w and v / w fall into the image all the same.
    Homography sourceFromResult{1, 0, -20, 0, 1, -20, -0.125, 0, 1};
    const Image light({100, 100}, 1, 1.0f);
    const Image behind = warpedPerspective(light, sourceFromResult, {16, 4});
    for (float value : behind.data()) QCOMPARE(value, 0.0f);
    // With the other sign it is those points that are in view.
    for (double& value : sourceFromResult) value = -value;
    QCOMPARE(warpedPerspective(light, sourceFromResult, {16, 4}).at(12, 1, 0), 1.0f);
  }

  void impossibleQuadrilateralsAreRefused_data() {
    QTest::addColumn<bool>("twice");
    QTest::newRow("three on a line") << false;
    QTest::newRow("a corner twice") << true;
  }
  void impossibleQuadrilateralsAreRefused() {
    QFETCH(bool, twice);
    std::array<Point, 4> corners{{{0, 0}, {5, 5}, {10, 10}, {0, 10}}};
    if (twice) corners[1] = corners[0];
    QVERIFY_THROWS_EXCEPTION(Error, homographyFromCorners({4, 4}, corners));
    QVERIFY_THROWS_EXCEPTION(Error, inverted(Homography{}));
  }
};

QTEST_APPLESS_MAIN(TestResample)
#include "test_resample.moc"
