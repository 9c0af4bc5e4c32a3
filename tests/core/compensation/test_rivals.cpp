// SPDX-License-Identifier: MIT
// What others do, at its best: photographs of their own, and defocus undone to the end.
#include "relucent/compensation/rivals.h"

#include <QtTest>
#include <cmath>

#include "core/inverse/synthetic_transport.h"
#include "relucent/compensation/colour_spline.h"
#include "relucent/inverse/windows.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::image;
using namespace relucent::inverse;
using namespace relucent::synthetic;

namespace {

Progress quiet;

MeasuredVenue venueOf(const SceneSettings& settings) {
  Scene scene = makeScene(settings);
  const CameraStack flood = scene.transport.floodlight();
  return {std::move(scene.transport), std::move(scene.black), flood, std::move(scene.usable)};
}

struct Prepared {
  MeasuredVenue venue;
  WindowInverse inverse;

  explicit Prepared(MeasuredVenue its) : venue(std::move(its)) {
    inverse = computeWindows(venue.transport, venue.usable, {}, quiet);
  }

  /// Free of noise; `gain`: of the venue since it was measured, `bend`: drive d gives d + bend d (1 - d).
  Photograph photographs(float gain, float bend = 0.0f) const {
    return [this, gain, bend](const ProjectorStack& p) {
      ProjectorStack bent = p;
      for (float& drive : bent) drive += bend * drive * (1.0f - drive);
      CameraStack seen = venue.transport.apply(bent);
      for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = gain * seen[i] + venue.black[i];
      return seen;
    };
  }
};

/// Root mean square over the reachable pixels, of white.
double errorOf(const CameraStack& seen, const Target& target) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!target.reachable[i / 3]) continue;
    sum += std::pow(static_cast<double>((seen[i] - target.wanted[i]) / target.white[0]), 2);
    count += 1.0;
  }
  return std::sqrt(sum / count);
}

double objectiveOf(const MeasuredVenue& venue, const Target& target, const ProjectorStack& p) {
  const CameraStack seen = venue.transport.apply(p);
  double sum = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    sum += static_cast<double>(target.weight[i / 3]) *
           std::pow(static_cast<double>(seen[i] - target.asked[i]), 2);
  return sum;
}

/// Each camera pixel sees one projector pixel and nothing else, in colours of its own.
MeasuredVenue onePixelEach(std::uint64_t seed) {
  constexpr Size size{24, 18};
  const transport::NodeLayout layout{Rasters(size)};
  transport::BlockSparseBuilder builder(layout.count(), std::vector<float>(size.count(), 1.0f));
  for (std::size_t i = 0; i < size.count(); ++i) {
    Random random({seed, i});
    transport::ColourBlock mixing;
    for (int c = 0; c < 3; ++c)
      for (int p = 0; p < 3; ++p)
        mixing(c, p) = static_cast<float>((c == p ? 0.5 : 0.05) * (0.5 + 0.5 * random.uniform()));
    const Pixel at = pixelAt(size, i);
    builder.add(i, layout.index({0, 0, at.x, at.y}), mixing);
  }
  MeasuredVenue venue;
  venue.transport = transport::TransportMatrix(Rasters(size), Rasters(size), builder.build());
  venue.flood = venue.transport.floodlight();
  venue.black.assign(venue.flood.size(), 0.001f);
  venue.usable.assign(size.count(), 1);
  return venue;
}

/// Dim enough for a venue that gives a tenth less than it did.
Target dimTarget(const MeasuredVenue& venue, std::uint64_t seed) {
  Image content = makeContent(Content::natural, {80, 60}, seed);
  for (float& value : content.data()) value = 0.1f + 0.4f * value;
  TargetSettings settings;
  settings.reachablePercentile = 0.0;
  return fitTarget(content, venue, settings);
}

}  // namespace

class TestRivals : public QObject {
  Q_OBJECT

  static void seeds() {
    QTest::addColumn<quint64>("seed");
    for (quint64 seed : {1u, 5u, 9u}) QTest::addRow("seed %llu", seed) << seed;
  }

 private slots:
  /// Law: samples of a linear map give that map, everywhere and however smooth.
  void aSplineOfALineIsTheLine() {
    Random random{20261125};
    const auto colour = [&] { return Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform()); };
    Eigen::Matrix3d map;
    map << colour(), colour(), colour();
    const Eigen::Vector3d offset = colour();
    std::vector<Eigen::Vector3d> from, to;
    for (int m = 0; m < 27; ++m) {
      from.push_back(colour());
      to.push_back(map * from.back() + offset);
    }
    for (double smoothing : {0.0, 0.01, 10.0}) {
      const ColourSpline spline(from, to, smoothing);
      for (int trial = 0; trial < 20; ++trial) {
        const Eigen::Vector3d x = 3.0 * (colour() - Eigen::Vector3d::Constant(0.5));
        QVERIFY((spline(x) - (map * x + offset)).norm() < 1e-9);  // of double precision, 31 unknowns
      }
    }
  }
  /// Law: unsmoothed it goes through its samples; smoothed it stays away by as much as its bends weigh.
  void anUnsmoothedSplineMeetsItsSamples() {
    Random random{20261126};
    const auto colour = [&] { return Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform()); };
    std::vector<Eigen::Vector3d> from, to;
    for (int m = 0; m < 30; ++m) {
      from.push_back(colour());
      to.push_back(from.back().array().sqrt().matrix() + 0.1 * colour());
    }
    const ColourSpline exact(from, to, 0.0), smooth(from, to, 1.0);
    double apart = 0.0;
    for (std::size_t m = 0; m < from.size(); ++m) {
      QVERIFY((exact(from[m]) - to[m]).norm() < 1e-9);
      apart += (smooth(from[m]) - to[m]).norm();
    }
    QVERIFY(apart / static_cast<double>(from.size()) > 0.01);
  }

  void photographsCorrect_data() { seeds(); }
  /// Law: where each pixel is on its own and the venue gives a tenth less than it did, mix misses by a tenth,
  /// and every photograph leaves a tenth of what was missing.
  void photographsCorrect() {
    QFETCH(quint64, seed);
    const Prepared prepared(onePixelEach(seed));
    const Compensator compensator(prepared.venue, prepared.inverse);
    const Target target = dimTarget(prepared.venue, seed);
    const Photograph photograph = prepared.photographs(0.9f);
    const double uncorrected =
        errorOf(photograph(compensator.solve(Method::mix, target, quiet).projector), target);
    for (int corrections : {1, 2, 4}) {
      RivalCompensator rivals(compensator, prepared.inverse, photograph, {.corrections = corrections});
      const double error =
          errorOf(photograph(rivals.solve(Rival::corrected, target, quiet).projector), target);
      QCOMPARE(rivals.photographs(Rival::corrected), corrections);
      // Roundings of floats, of a light of about one.
      QVERIFY2(std::abs(error - std::pow(0.1, corrections) * uncorrected) < 1e-6,
               qPrintable(QString("%1 of %2 after %3").arg(error).arg(uncorrected).arg(corrections)));
    }
  }

  void photographsCorrectStrayLight_data() { seeds(); }
  /// Law: where light goes astray and pictures blur, each photograph brings it nearer still.
  void photographsCorrectStrayLight() {
    QFETCH(quint64, seed);
    SceneSettings scene;
    scene.seed = seed;
    const Prepared prepared(venueOf(scene));
    const Compensator compensator(prepared.venue, prepared.inverse);
    const Target target = dimTarget(prepared.venue, seed);
    const Photograph photograph = prepared.photographs(0.9f);
    double before = errorOf(photograph(compensator.solve(Method::mix, target, quiet).projector), target);
    for (int corrections : {1, 2, 4, 8}) {
      RivalCompensator rivals(compensator, prepared.inverse, photograph, {.corrections = corrections});
      const double error =
          errorOf(photograph(rivals.solve(Rival::corrected, target, quiet).projector), target);
      QVERIFY2(error < before, qPrintable(QString("%1 after %2").arg(error).arg(before)));
      before = error;
    }
  }

  void aSplineFollowsTheDevice_data() { seeds(); }
  /// Law: where each pixel is on its own and the projector is straight, the spline is mix; where the
  /// projector bends, mix misses and the spline does not. Its photographs serve every picture.
  void aSplineFollowsTheDevice() {
    QFETCH(quint64, seed);
    const Prepared prepared(onePixelEach(seed));
    const Compensator compensator(prepared.venue, prepared.inverse);
    const Target target = dimTarget(prepared.venue, seed);
    const ProjectorStack mix = compensator.solve(Method::mix, target, quiet).projector;

    RivalCompensator straight(compensator, prepared.inverse, prepared.photographs(1.0f), {.levels = 3});
    const ProjectorStack spline = straight.solve(Rival::robust, target, quiet).projector;
    for (std::size_t j = 0; j < mix.size(); ++j)
      QVERIFY(std::abs(spline[j] - mix[j]) < 2e-3f);  // half a code: T keeps 15 bits of a row's brightest
    straight.solve(Rival::robust, target, quiet);
    QCOMPARE(straight.photographs(Rival::robust), 27);

    const Photograph bends = prepared.photographs(1.0f, 0.5f);
    RivalCompensator bent(compensator, prepared.inverse, bends);
    const double missed = errorOf(bends(mix), target),
                 met = errorOf(bends(bent.solve(Rival::robust, target, quiet).projector), target);
    QVERIFY2(met < 0.2 * missed, qPrintable(QString("%1 of %2").arg(met).arg(missed)));
  }

  void defocusIsUndoneToTheEnd_data() { seeds(); }
  /// Law: where there is nothing but defocus, it is the constrained optimum, and sharpen on its way there;
  /// where there is other light, it falls behind the optimum.
  void defocusIsUndoneToTheEnd() {
    QFETCH(quint64, seed);
    SceneSettings scene;
    scene.seed = seed;
    for (const bool isAlone : {true, false}) {
      if (isAlone) scene.interreflection = scene.farField = 0.0;
      scene.sharpest = scene.softest = isAlone ? 0.5 : 1.0;
      const Prepared prepared(venueOf(scene));
      const Compensator compensator(prepared.venue, prepared.inverse);
      const Target target = fitTarget(makeContent(Content::natural, {80, 60}, seed), prepared.venue, {});
      RivalCompensator rivals(compensator, prepared.inverse, {});
      const auto objective = [&](const Compensation& c) {
        return objectiveOf(prepared.venue, target, c.projector);
      };
      const double undone = objective(rivals.solve(Rival::deconvolved, target, quiet)),
                   sharpened = objective(compensator.solve(Method::sharpen, target, quiet)),
                   best = objective(compensator.solve(Method::optimum, target, quiet));
      QCOMPARE(rivals.photographs(Rival::deconvolved), 0);
      if (isAlone)
        QVERIFY(undone < sharpened && undone < 1.1 * best);
      else
        QVERIFY(undone > 1.5 * best);
      scene = {};
      scene.seed = seed;
    }
  }

  void wrongSettingsAreNamed() {
    QVERIFY(problems(RivalSettings()).empty());
    QCOMPARE(problems(RivalSettings{.corrections = 0, .levels = 1, .smoothing = -1.0}).size(),
             std::size_t{3});
    for (Rival rival : allValues<Rival>()) QVERIFY(valueNamed<Rival>(nameOf(rival)) == rival);
  }
};

QTEST_GUILESS_MAIN(TestRivals)
#include "test_rivals.moc"
