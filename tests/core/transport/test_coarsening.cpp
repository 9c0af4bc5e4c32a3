// SPDX-License-Identifier: MIT
#include "relucent/transport/coarsening.h"

#include <QtTest>

#include "random_blocks.h"
#include "relucent/transport/statistics.h"

using namespace relucent;
using namespace relucent::transport;

namespace {

// Codes have 16 bits.
constexpr double rounding = 3e-4;

Acquisition randomAcquisition(Size camera, Size projector) {
  Acquisition acquisition;
  NodeLayout layout(projector);
  acquisition.transport = {camera, projector,
                           randomBlocks(camera.count(), layout.count(), 0.2, 5, -0.1f).sparse};
  acquisition.black = CameraStack(randomStack(camera.count(), 1));
  acquisition.blackVariance = CameraStack(randomStack(camera.count(), 2));
  acquisition.flood = CameraStack(randomStack(camera.count(), 3));
  acquisition.floodVariance = CameraStack(randomStack(camera.count(), 4));
  acquisition.flagged.assign(camera.count(), 0);
  return acquisition;
}

/// Every value of a pattern in all pixels of its block.
ProjectorStack spread(const ProjectorStack& few, Size size, int levels) {
  Size small = coarsened(Rasters(size), levels).size(0);
  ProjectorStack pattern(3 * size.count());
  for (std::size_t i = 0; i < size.count(); ++i) {
    Pixel at = pixelAt(size, i);
    std::size_t from = indexOf(small, {at.x >> levels, at.y >> levels});
    for (std::size_t c = 0; c < 3; ++c) pattern[3 * i + c] = few[3 * from + c];
  }
  return pattern;
}

double apart(const Stack& a, const Stack& b) {
  return (vectorOf(a) - vectorOf(b)).norm() / vectorOf(b).norm();
}

}  // namespace

class TestCoarsening : public QObject {
  Q_OBJECT

 private slots:
  void coarsenings_data() {
    QTest::addColumn<int>("cameras");
    QTest::addColumn<int>("projectors");
    QTest::newRow("nothing") << 0 << 0;
    QTest::newRow("cameras by 2") << 1 << 0;
    QTest::newRow("projectors by 4") << 0 << 2;
    QTest::newRow("both by 2") << 1 << 1;
    QTest::newRow("more than there is") << 5 << 6;
  }

  /// T_coarse p = joined(T q).
  void seesTheMeanOfTheJoinedPixels_data() { coarsenings_data(); }
  void seesTheMeanOfTheJoinedPixels() {
    QFETCH(int, cameras);
    QFETCH(int, projectors);
    const Size camera{11, 7}, projector{16, 8};
    const Acquisition whole = randomAcquisition(camera, projector);
    const Acquisition few = coarsened(whole, {cameras, projectors, 0});
    const std::size_t pixels = few.transport.projectors().count();
    const ProjectorStack pattern(randomStack(pixels, 9));
    const CameraStack seen = joined(whole.transport.apply(spread(pattern, projector, projectors)), camera,
                                    CameraMask(camera.count(), 1), cameras);
    QVERIFY(apart(few.transport.apply(pattern), seen) < rounding);
    QCOMPARE(few.black.size(), seen.size());
  }

  /// Law: T 1 is the same, and so is every pattern that is even within the leaves.
  void coarserLeavesKeepTheLight() {
    const Size camera{6, 5}, projector{16, 16};
    const Acquisition whole = randomAcquisition(camera, projector);
    const Acquisition coarse = coarsened(whole, {0, 0, 2});
    QCOMPARE(finestSide(coarse.transport), 4);
    const ProjectorStack pattern = spread(ProjectorStack(randomStack(16, 9)), projector, 2);
    QVERIFY(apart(coarse.transport.apply(pattern), whole.transport.apply(pattern)) < rounding);
  }

  void whatIsFlaggedDoesNotCount() {
    const Size camera{4, 4}, projector{8, 8};
    Acquisition whole = randomAcquisition(camera, projector);
    whole.flagged[0] = 1;  // one of four
    for (std::size_t row : {2, 3, 6}) whole.flagged[row] = 1;
    whole.black[0] = 1e6f;
    const Acquisition few = coarsened(whole, {1, 0, 0});
    QCOMPARE(few.flagged, (CameraMask{0, 1, 0, 0}));
    QVERIFY(few.black[0] < 1.0f);
    const float left = (whole.black[3] + whole.black[12] + whole.black[15]) / 3.0f;
    QVERIFY(std::abs(few.black[0] - left) < 1e-5f);
  }

  void meansHaveLessVariance() {
    const Size camera{8, 8};
    Acquisition whole = randomAcquisition(camera, {8, 8});
    whole.blackVariance.assign(whole.blackVariance.size(), 0.16f);
    const Acquisition few = coarsened(whole, {2, 0, 0});
    for (float value : few.blackVariance) QCOMPARE(value, 0.01f);
  }
};

QTEST_APPLESS_MAIN(TestCoarsening)
#include "test_coarsening.moc"
