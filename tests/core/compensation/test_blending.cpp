// SPDX-License-Identifier: MIT
// Projectors solved on their own and blended, and the seams that are seen where their pictures end.
#include "relucent/compensation/blending.h"

#include <QtTest>
#include <cmath>

#include "core/inverse/synthetic_transport.h"
#include "relucent/compensation/seams.h"
#include "relucent/image/colour.h"
#include "relucent/inverse/windows.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::image;
using namespace relucent::inverse;
using namespace relucent::synthetic;
using namespace relucent::transport;

namespace {

constexpr int width = 40, height = 20, each = 24, shift = width - each;  // 8 columns overlap

/// A camera sees two projectors side by side, pixel for pixel. `crosstalk`: what each pixel of a projector
/// sends to the whole wall besides.
MeasuredVenue sideBySide(float crosstalk, int projectors = 2) {
  const Rasters cameras(Size{width, height});
  const Rasters rasters(projectors == 2 ? std::vector<Size>(2, Size{each, height})
                                        : std::vector<Size>{Size{width, height}});
  const NodeLayout layout(rasters);
  BlockSparseBuilder builder(layout.count(), std::vector<float>(cameras.count(), 1.0f));
  const ColourBlock one = ColourBlock::Identity();
  for (std::size_t row = 0; row < cameras.count(); ++row) {
    const Pixel at = pixelAt(cameras.size(0), row);
    for (int k = 0; k < projectors; ++k) {
      const int x = at.x - k * shift, top = layout.levels(static_cast<std::size_t>(k)) - 1;
      if (x >= 0 && x < rasters.size(static_cast<std::size_t>(k)).width)
        builder.add(row, layout.index({k, 0, x, at.y}), (0.6f * one).eval());
      if (crosstalk > 0.0f) builder.add(row, layout.index({k, top, 0, 0}), (crosstalk * one).eval());
    }
  }
  MeasuredVenue venue;
  venue.transport = TransportMatrix(cameras, rasters, builder.build());
  venue.flood = venue.transport.floodlight();
  venue.black.assign(venue.flood.size(), 0.001f);
  venue.usable.assign(cameras.count(), 1);
  return venue;
}

Target targetIn(const MeasuredVenue& venue) {
  TargetSettings settings;
  settings.corners = uprightCorners(0, 0, width, height);
  Image content({width, height}, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        content.at(x, y, c) = static_cast<float>(0.1 + 0.5 * cloud(5 * x, 5 * y, 3));
  return fitTarget(content, venue, settings);
}

double errorOf(const MeasuredVenue& venue, const Target& target, const ProjectorStack& p) {
  const CameraStack seen = venue.transport.apply(p);
  double sum = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    sum += std::pow(static_cast<double>(seen[i] + venue.black[i] - target.wanted[i]), 2);
  return std::sqrt(sum / static_cast<double>(seen.size()));
}

struct Solver {
  explicit Solver(const MeasuredVenue& venue_) : venue(venue_) {
    Progress silent;
    inverse = computeWindows(venue.transport, venue.usable, {}, silent);
  }
  ProjectorStack separately(const Target& target) const {
    Progress silent;
    return solvedSeparately(Compensator(venue, inverse), target, {}, silent).projector;
  }
  ProjectorStack jointly(const Target& target) const {
    Progress silent;
    return Compensator(venue, inverse).solve(Method::optimum, target, silent).projector;
  }
  const MeasuredVenue& venue;
  WindowInverse inverse;
};

}  // namespace

class TestBlending : public QObject {
  Q_OBJECT

 private slots:
  /// Law: masks sum to one, are 1 where a projector is alone, and fall smoothly to nothing at its edge.
  void masksAreRamps() {
    const MeasuredVenue venue = sideBySide(0.0f);
    const auto masks = blendingMasks(venue.transport, {});
    QCOMPARE(masks.size(), std::size_t{2});
    for (int y = 0; y < height; ++y) {
      float before = 1.0f;
      for (int x = 0; x < width; ++x) {
        const std::size_t i = indexOf({width, height}, {x, y});
        QVERIFY(std::abs(masks[0][i] + masks[1][i] - 1.0f) < 1e-6f);
        if (x < shift) QCOMPARE(masks[0][i], 1.0f);
        if (x >= each) QCOMPARE(masks[0][i], 0.0f);
        QVERIFY(masks[0][i] <= before);
        before = masks[0][i];
        // Seen from the other side it is the other's.
        QVERIFY(std::abs(masks[0][i] - masks[1][indexOf({width, height}, {width - 1 - x, y})]) < 1e-6f);
      }
      const std::size_t middle = indexOf({width, height}, {width / 2, y});
      if (y > 4 && y < height - 5) QVERIFY(masks[0][middle] > 0.3f && masks[0][middle] < 0.7f);
      if (y > 4 && y < height - 5) QVERIFY(masks[0][indexOf({width, height}, {each - 1, y})] < 0.1f);
    }
  }

  /// Where no projector lights directly the mask goes by what there is of each one's light.
  void whatIsLitIndirectlyIsShared() {
    const Rasters cameras(Size{4, 4}), projectors(std::vector<Size>(2, Size{16, 16}));
    const NodeLayout layout(projectors);
    BlockSparseBuilder builder(layout.count(), std::vector<float>(cameras.count(), 1.0f));
    for (std::size_t row = 0; row < cameras.count(); ++row)
      for (int k = 0; k < 2; ++k)
        builder.add(row, layout.index({k, layout.levels(0) - 1, 0, 0}),
                    ((k == 0 ? 0.3f : 0.1f) * ColourBlock::Identity()).eval());
    const TransportMatrix transport(cameras, projectors, builder.build());
    for (const std::vector<float>& mask : blendingMasks(transport, {}))
      for (float value : mask) QVERIFY(std::abs(value - 0.75f) < 1e-3f || std::abs(value - 0.25f) < 1e-3f);
  }

  /// Law: one projector that is solved on its own is the optimum; and so are two that send each other no
  /// light.
  void withoutCommonLightItIsTheOptimum_data() {
    QTest::addColumn<int>("projectors");
    QTest::newRow("one") << 1;
    QTest::newRow("two") << 2;
  }
  void withoutCommonLightItIsTheOptimum() {
    QFETCH(int, projectors);
    const MeasuredVenue venue = sideBySide(0.0f, projectors);
    const Target target = targetIn(venue);
    const Solver solver(venue);
    const double apart = errorOf(venue, target, solver.separately(target)),
                 together = errorOf(venue, target, solver.jointly(target));
    // The solver ends where its steps are below a twentieth of a code.
    QVERIFY2(apart < 2e-4 && together < 2e-4, qPrintable(QString("%1 %2").arg(apart).arg(together)));
  }

  /// What each sends into the other's part nobody takes back.
  void commonLightIsNotTakenBack() {
    const MeasuredVenue venue = sideBySide(0.15f);
    const Target target = targetIn(venue);
    const Solver solver(venue);
    const double apart = errorOf(venue, target, solver.separately(target)),
                 together = errorOf(venue, target, solver.jointly(target));
    qInfo("%.4f apart, %.4f together", apart, together);
    QVERIFY(apart > 0.02 && together < 0.25 * apart);
  }

  /// Law: an even picture has no seam; a step at the edge is one of its own size, wherever the edge is looked
  /// at.
  void seamsAreSteps() {
    const MeasuredVenue venue = sideBySide(0.0f);
    const CameraMask all(venue.usable.size(), 1);
    const SeamPairs pairs = seamPairs(venue.transport, all, 3, {});
    QCOMPARE(pairs.across.size(), static_cast<std::size_t>(2 * 3 * height));  // two edges, three columns each
    for (const auto& [a, b] : pairs.across) {
      const int left = static_cast<int>(a) % width, right = static_cast<int>(b) % width;
      QCOMPARE(right - left, 3);
      QVERIFY((left < shift && right >= shift) || (left < each && right >= each));
    }
    const std::array<float, 3> white{0.8f, 0.8f, 0.8f};
    CameraStack even(3 * all.size(), 0.4f), stepped = even;
    const Rasters& cameras = venue.transport.cameras();
    QCOMPARE(seamsOf(even, cameras, all, white, pairs).p95, 0.0);
    for (std::size_t i = 0; i < stepped.size(); ++i)
      if (static_cast<int>(i / 3) % width >= shift) stepped[i] = 0.44f;
    const Seams seams = seamsOf(stepped, cameras, all, white, pairs);
    const auto labOf = [](double light) { return labFromXyz(xyzFromLinearRgb({light, light, light})); };
    const double step = ciede2000(labOf(0.5), labOf(0.55));
    QVERIFY2(std::abs(seams.p95 - step) < 0.01, qPrintable(QString("%1 %2").arg(seams.p95).arg(step)));
    QVERIFY(seams.mean > 0.3 * step && seams.mean < 0.5 * step);  // of one edge of two, smoothed
    QVERIFY(seams.elsewhere < 0.05 * step);
    QVERIFY(std::isnan(seamsOf(even, cameras, all, white, {}).mean));
  }
};

QTEST_GUILESS_MAIN(TestBlending)
#include "test_blending.moc"
