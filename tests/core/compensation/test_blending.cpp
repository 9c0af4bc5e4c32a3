// SPDX-License-Identifier: MIT
// Projectors solved on their own and blended, and the seams that are seen where their pictures end.
#include "relucent/compensation/blending.h"

#include <QtTest>
#include <array>
#include <cmath>

#include "core/inverse/synthetic_transport.h"
#include "relucent/base/random.h"
#include "relucent/compensation/black_steps.h"
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
/// sends to the whole wall besides. `lamp`: of the last one, relative to the first one's.
MeasuredVenue sideBySide(float crosstalk, int projectors = 2, const std::array<float, 3>& lamp = {1, 1, 1}) {
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
        builder.add(row, layout.index({k, 0, x, at.y}),
                    k == 1 ? ColourBlock(0.6f * Eigen::Map<const Eigen::Vector3f>(lamp.data()).asDiagonal())
                           : (0.6f * one).eval());
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

  /// Law: alone, one shows what is wanted where it lights the wall, and the others stay black.
  void aloneItShowsItsPart() {
    const MeasuredVenue venue = sideBySide(0.0f);
    const Target target = targetIn(venue);
    const Solver solver(venue);
    const Rasters& projectors = venue.transport.projectors();
    for (std::size_t k = 0; k < 2; ++k) {
      Progress silent;
      const ProjectorStack shown =
          solvedAlone(Compensator(venue, solver.inverse), target, k, {}, silent).projector;
      for (std::size_t j = 0; j < projectors.count(); ++j)
        if (j / projectors.size(0).count() != k) QCOMPARE(shown[3 * j + 1], 0.0f);
      const CameraStack seen = venue.transport.apply(shown);
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const int x = pixelAt({width, height}, i / 3).x;
        const bool lit = k == 0 ? x < each : x >= shift;
        // Half a code of white is a five-hundredth of it.
        QVERIFY(std::abs(seen[i] - (lit ? target.asked[i] : 0.0f)) < 2e-3f * target.white[i % 3]);
      }
    }
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
      const auto [left, right] = std::minmax({static_cast<int>(a) % width, static_cast<int>(b) % width});
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
    // Of three columns of pairs, of which smoothing leaves two of them two thirds.
    QVERIFY(seams.edgeP95 > 0.6 * step && seams.edgeP95 < step + 0.01);

    // Law: what is uneven without a seam is none of its own.
    for (CameraStack* uneven : {&even, &stepped})
      for (std::size_t i = 0; i < all.size(); ++i) {
        Random random{7, i};
        const float noise = 1.0f + 0.15f * static_cast<float>(random.normal());
        for (std::size_t c = 0; c < 3; ++c) (*uneven)[3 * i + c] *= noise;
      }
    const Seams noise = seamsOf(even, cameras, all, white, pairs);
    const Seams both = seamsOf(stepped, cameras, all, white, pairs);
    qInfo("p95 %.2f beside %.2f, edge alone %.2f; with a step of %.2f: %.2f, %.2f", noise.p95,
          noise.elsewhereP95, noise.edgeP95, step, both.p95, both.edgeP95);
    QVERIFY(noise.edgeP95 < 0.5 * noise.p95 && std::abs(noise.p95 - noise.elsewhereP95) < 0.25 * noise.p95);
    QVERIFY(both.edgeP95 < both.p95 && std::abs(both.edgeP95 - step) < 0.5 * step);
  }

  /// Law: without black there is no step of it and no lift; where two projectors' black meet, the least lift
  /// hides the step, and a little less does not.
  void blackIsLiftedNoMoreThanNeeded_data() {
    QTest::addColumn<double>("black");
    for (double black : {0.0, 1e-5, 0.002, 0.01, 0.04}) QTest::addRow("%g", black) << black;
  }
  void blackIsLiftedNoMoreThanNeeded() {
    QFETCH(double, black);
    MeasuredVenue venue = sideBySide(0.0f);
    for (std::size_t i = 0; i < venue.black.size(); ++i) {
      const int x = static_cast<int>(i / 3) % width;
      venue.black[i] = static_cast<float>(black) * (x >= shift && x < each ? 2.0f : 1.0f);
    }
    const Target target = targetIn(venue);
    const SeamPairs pairs = seamPairs(venue.transport, target.inside, 3, {});
    const double bare = blackSteps(venue, target, pairs, 0.0).p95,
                 lift = leastBlackLift(venue, target, pairs, 1.0, 0.2);
    qInfo("steps of %.2f, least lift %.4f of white", bare, lift);
    if (bare <= 1.0) {
      QCOMPARE(lift, 0.0);
      return;
    }
    QVERIFY(blackSteps(venue, target, pairs, lift).p95 <= 1.0);
    // By itself it greys no picture so much: then it lets the edges be.
    QVERIFY(std::abs(leastBlackLift(venue, target, pairs) - (lift <= 0.05 ? lift : 0.0)) <= 1e-4);
    QVERIFY(blackSteps(venue, target, pairs, lift - 2e-4).p95 > 1.0);
    // Never more than what makes all black even.
    QVERIFY(lift <= 2.0 * black / static_cast<double>(target.white[0]) + 1e-4);
    // What is asked for then is what is seen, by the solver too.
    TargetSettings settings;
    settings.corners = uprightCorners(0, 0, width, height);
    settings.blackLift = lift;
    const Target lifted = fitTarget(Image({width, height}, 3), venue, settings);
    const Solver solver(venue);
    CameraStack seen = venue.transport.apply(solver.jointly(lifted));
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i] += venue.black[i];
    QVERIFY(seamsOf(seen, venue.transport.cameras(), lifted.inside, lifted.white, pairs).p95 < 1.1);
  }

  void unlikeProjectorsShareTheirLight_data() {
    QTest::addColumn<double>("red");
    QTest::addColumn<double>("green");
    QTest::addColumn<double>("blue");
    QTest::newRow("alike") << 1.0 << 1.0 << 1.0;
    QTest::newRow("an old lamp") << 0.5 << 0.5 << 0.5;
    QTest::newRow("a dark lamp") << 0.2 << 0.2 << 0.2;
    QTest::newRow("warm") << 1.0 << 0.8 << 0.6;
    QTest::newRow("blue") << 0.7 << 0.9 << 1.2;
  }
  /// Law: no seam of a flat grey, though one lamp is dark or of another white; where both reach, the bright
  /// one carries it.
  void unlikeProjectorsShareTheirLight() {
    QFETCH(double, red);
    QFETCH(double, green);
    QFETCH(double, blue);
    const std::array<float, 3> lamp{static_cast<float>(red), static_cast<float>(green),
                                    static_cast<float>(blue)};
    const MeasuredVenue venue = sideBySide(0.02f, 2, lamp);
    const Solver solver(venue);
    for (double grey : {0.1, 0.25, 0.5, 0.75}) {
      TargetSettings settings;
      settings.corners = uprightCorners(0, 0, width, height);
      settings.reachablePercentile = 0.0;
      const Target target = fitTarget(Image({width, height}, 3, static_cast<float>(grey)), venue, settings);
      const ProjectorStack p = solver.jointly(target);
      CameraStack seen = venue.transport.apply(p);
      for (std::size_t i = 0; i < seen.size(); ++i) seen[i] += venue.black[i];
      const SeamPairs pairs = seamPairs(venue.transport, target.inside, 3, {});
      const Seams seams = seamsOf(seen, venue.transport.cameras(), target.inside, target.white, pairs);
      QVERIFY2(seams.p95 < 1.0, qPrintable(QString("%1 grey: %2").arg(grey).arg(seams.p95)));
      std::array<double, 2> light{};  // of each where both reach
      const Rasters& projectors = venue.transport.projectors();
      for (int y = 0; y < height; ++y)
        for (int x = shift; x < each; ++x)
          for (std::size_t c = 0; c < 3; ++c) {
            light[0] += static_cast<double>(p[3 * indexOf(projectors.size(0), {x, y}) + c]);
            light[1] += static_cast<double>(
                lamp[c] * p[3 * (projectors.offset(1) + indexOf(projectors.size(1), {x - shift, y})) + c]);
          }
      if (red < 1.0 && blue < 1.0) QVERIFY(light[0] > light[1]);
    }
  }
};

QTEST_GUILESS_MAIN(TestBlending)
#include "test_blending.moc"
