// SPDX-License-Identifier: MIT
#include "relucent/compensation/methods.h"

#include <QtTest>
#include <cmath>
#include <map>

#include "core/inverse/synthetic_transport.h"
#include "relucent/image/colour.h"
#include "relucent/image/metrics.h"

using namespace relucent;
using namespace relucent::clustering;
using namespace relucent::compensation;
using namespace relucent::image;
using namespace relucent::inverse;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

Progress quiet;

/// A scene, its measurement, and everything prepared from that.
struct Prepared {
  Scene scene;
  MeasuredVenue venue;
  WindowInverse inverse;

  explicit Prepared(const SceneSettings& settings, double noise = 0.0) : scene(makeScene(settings)) {
    venue = {noise > 0.0 ? measured(scene.transport, noise, 0.03 * noise, settings.seed) : scene.transport,
             scene.black, scene.transport.floodlight(), scene.usable};
    inverse = computeWindows(venue.transport, venue.usable, {}, quiet);
  }

  /// PSNR over reachable pixels, through the true transport.
  double psnr(Method method, const Target& target, const CompensatorSettings& settings = {}) const {
    ProjectorStack p = Compensator(venue, inverse, settings).solve(method, target, quiet).projector;
    CameraStack seen = scene.transport.apply(p);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!target.reachable[i / 3]) continue;
      sum += std::pow((seen[i] + scene.black[i] - target.wanted[i]) / target.white[0], 2);
      count += 1.0;
    }
    return -10.0 * std::log10(sum / count);
  }
};

}  // namespace

class TestMethods : public QObject {
  Q_OBJECT

  static void methodsThatWeigh() {
    QTest::addColumn<Method>("method");
    for (Method method : {Method::windows, Method::refined, Method::optimum})
      QTest::addRow("%s", std::string(nameOf(method)).c_str()) << method;
  }

 private slots:
  void namesAndMethodsMatch() {
    for (Method method : allValues<Method>()) QVERIFY(valueNamed<Method>(nameOf(method)) == method);
    QVERIFY(!valueNamed<Method>("magic"));
  }

  void moreKnowledgeIsBetter_data() {
    QTest::addColumn<int>("seed");
    QTest::addColumn<double>("softest");
    QTest::addColumn<double>("noise");
    for (int seed = 1; seed <= 3; ++seed) {
      QTest::addRow("seed %d, exact", seed) << seed << 1.5 << 0.0;
      QTest::addRow("seed %d, 3 %% noise", seed) << seed << 1.0 << 0.03;
    }
  }
  /// none < scalar <= mix < sharpen < windows, mix < clusters < windows < refined <= optimum, in the mean
  /// over contents of three kinds.
  void moreKnowledgeIsBetter() {
    QFETCH(int, seed);
    QFETCH(double, softest);
    QFETCH(double, noise);
    SceneSettings s;
    s.seed = static_cast<std::uint64_t>(seed);
    s.softest = softest;
    Prepared prepared(s, noise);
    std::map<Method, double> mean;
    for (Content kind : {Content::natural, Content::text, Content::saturated}) {
      Target target = fitTarget(makeContent(kind, {80, 60}, s.seed), prepared.venue, {});
      for (Method method : allValues<Method>()) mean[method] += prepared.psnr(method, target) / 3.0;
    }
    QString all;
    for (Method method : allValues<Method>()) all += QString::number(mean[method], 'f', 2) + " ";
    qInfo().noquote() << "none scalar mix sharpen clusters windows refined optimum:" << all;
    QVERIFY(mean[Method::none] < mean[Method::scalar]);
    QVERIFY(mean[Method::scalar] <= mean[Method::mix]);
    // The scenes are defocused: knowing that gets more than half a decibel, and less than knowing all.
    QVERIFY(mean[Method::sharpen] > mean[Method::mix] + 0.5);
    QVERIFY(mean[Method::sharpen] < mean[Method::optimum]);
    QVERIFY(mean[Method::clusters] > mean[Method::mix]);
    QVERIFY(mean[Method::clusters] < mean[Method::windows]);
    // Of what the constrained optimum gains over per-pixel mixing, a third and two thirds.
    double possible = mean[Method::optimum] - mean[Method::mix];
    QVERIFY(mean[Method::windows] > mean[Method::mix] + possible / 3.0);
    QVERIFY(mean[Method::refined] > mean[Method::mix] + possible * 2.0 / 3.0);
    QVERIFY(mean[Method::refined] > mean[Method::windows]);
    QVERIFY(mean[Method::optimum] >= mean[Method::refined]);
    QVERIFY(mean[Method::optimum] < mean[Method::refined] + 2.5);
  }

  void objectivesAgreeWhereAllIsAlike_data() { methodsThatWeigh(); }
  /// Where everything counts as much and can be had, it does not matter how much it counts.
  void objectivesAgreeWhereAllIsAlike() {
    QFETCH(Method, method);
    Prepared prepared(SceneSettings{});
    TargetSettings settings;
    settings.reachablePercentile = 0.0;
    const Image grey({80, 60}, 3, 0.5f);
    const Compensator compensator(prepared.venue, prepared.inverse);
    const ProjectorStack seen =
        compensator.solve(method, fitTarget(grey, prepared.venue, settings), quiet).projector;
    settings.objective = Objective::light;
    const ProjectorStack light =
        compensator.solve(method, fitTarget(grey, prepared.venue, settings), quiet).projector;
    // Rounding, which T^T attenuates to a few thousandths of C's largest values.
    for (std::size_t j = 0; j < seen.size(); ++j) QVERIFY(std::abs(seen[j] - light[j]) < 2e-3f);
  }

  void whatCountsIsSeen_data() { methodsThatWeigh(); }
  /// The dark gains more than the bright loses: what people see comes nearer to what was wanted.
  void whatCountsIsSeen() {
    QFETCH(Method, method);
    double gained = 0.0;
    for (std::uint64_t seed : {1, 2, 3}) {
      SceneSettings s;
      s.seed = seed;
      Prepared prepared(s);
      Image content = makeContent(Content::text, {80, 60}, seed);
      for (float& value : content.data()) value *= value;  // more of it dark
      const auto encodedError = [&](Objective objective) {
        TargetSettings settings;
        settings.objective = objective;
        const Target target = fitTarget(content, prepared.venue, settings);
        const ProjectorStack p =
            Compensator(prepared.venue, prepared.inverse).solve(method, target, quiet).projector;
        CameraStack is = prepared.venue.transport.apply(p);
        for (std::size_t i = 0; i < is.size(); ++i) is[i] += prepared.venue.black[i];
        const Rasters& cameras = prepared.venue.transport.cameras();
        return psnr(viewed(imageFromStack(is, cameras, 0), target.white),
                    viewed(imageFromStack(target.wanted, cameras, 0), target.white), 1.0, target.inside);
      };
      gained += (encodedError(Objective::seen) - encodedError(Objective::light)) / 3.0;
    }
    QVERIFY2(gained > 0.2, qPrintable(QString("%1 dB").arg(gained)));
  }

  void perPixelMethodsAreExactWithoutSpread_data() {
    QTest::addColumn<int>("method");
    for (Method method : {Method::mix, Method::sharpen, Method::windows, Method::refined, Method::optimum})
      QTest::addRow("%s", std::string(nameOf(method)).c_str()) << static_cast<int>(method);
  }
  /// Where every camera pixel sees one projector pixel of its own, nothing is lost.
  void perPixelMethodsAreExactWithoutSpread() {
    QFETCH(int, method);
    Size size{12, 8};
    NodeLayout layout{Rasters(size)};
    BlockSparseBuilder builder(layout.count(), std::vector<float>(size.count(), 1.0f));
    for (std::size_t i = 0; i < size.count(); ++i) {
      ColourBlock block;
      block << 0.8f, 0.1f, 0.0f, 0.1f, 0.8f, 0.1f, 0.0f, 0.1f, 0.8f;
      builder.add(i, i, ((0.6f + 0.4f * static_cast<float>(i % 5) / 4.0f) * block).eval());
    }
    TransportMatrix transport(size, size, builder.build());
    MeasuredVenue venue{transport, CameraStack(3 * size.count(), 0.001f), transport.floodlight(),
                        CameraMask(size.count(), 1)};
    WindowSettings sharp;
    sharp.ridge = 1e-3;
    WindowInverse inverse = computeWindows(transport, venue.usable, sharp, quiet);
    TargetSettings settings;
    settings.reachablePercentile = 0.0;
    settings.corners = uprightCorners(0, 0, 12, 8);
    Target target = fitTarget(makeContent(Content::natural, size, 3), venue, settings);
    ProjectorStack p =
        Compensator(venue, inverse).solve(static_cast<Method>(method), target, quiet).projector;
    CameraStack seen = transport.apply(p);
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (target.reachable[i / 3])
        // The windows' unmixing and ridge, and the solver's tolerance: all well below half a percent of
        // white.
        QVERIFY2(std::abs(seen[i] + 0.001f - target.wanted[i]) < 5e-3f * target.white[0],
                 qPrintable(QString::number(seen[i] + 0.001f - target.wanted[i])));
  }

  /// Without indirect light nothing is left to know beyond the defocus.
  void sharpeningIsTheOptimumWithoutIndirectLight() {
    SceneSettings s;
    s.interreflection = 0.0;
    s.farField = 0.0;
    s.softest = 0.8;
    Prepared prepared(s);
    Target target = fitTarget(makeContent(Content::natural, {80, 60}, 5), prepared.venue, {});
    // Twenty steps of steepest descent would not get quite as far.
    CompensatorSettings settings;
    settings.sharpening = settings.optimum;
    double sharpened = prepared.psnr(Method::sharpen, target, settings);
    double best = prepared.psnr(Method::optimum, target, settings);
    // Both stop at the same tolerance, coming from different sides.
    QVERIFY2(std::abs(sharpened - best) < 0.3, qPrintable(QString("%1 %2").arg(sharpened).arg(best)));
  }

  void outsideTheContentIsBlack() {
    SceneSettings s;
    Prepared prepared(s);
    TargetSettings settings;
    settings.corners = Corners{{{8, 6}, {30, 9}, {28, 24}, {10, 22}}};
    Target target = fitTarget(Image({16, 12}, 3, 0.8f), prepared.venue, settings);
    Compensator compensator(prepared.venue, prepared.inverse);
    for (Method method : allValues<Method>()) {
      Compensation c = compensator.solve(method, target, quiet);
      std::size_t lit = 0;
      for (std::size_t j = 0; j < c.projector.size(); ++j) {
        QVERIFY(c.projector[j] >= 0.0f && c.projector[j] <= 1.0f);
        std::int32_t i = compensator.brightestCameraPixel()[j / 3];
        if (i < 0 || !target.inside[static_cast<std::size_t>(i)]) QCOMPARE(c.projector[j], 0.0f);
        lit += c.projector[j] > 0.0f;
      }
      QVERIFY(lit > c.projector.size() / 8);
    }
  }

  /// C T^T W T has its spectrum between 0 and 1, so this is what keeps `refined` from blowing anything up,
  /// after however many of its steps a frame has time for.
  void darkPicturesAreSolvedAsWell_data() {
    QTest::addColumn<float>("brightness");
    QTest::newRow("bright") << 1.0f;
    QTest::newRow("dim") << 0.1f;
    QTest::newRow("night") << 0.01f;
  }
  /// Law: how near the solve comes to its end does not depend on how bright the picture is.
  void darkPicturesAreSolvedAsWell() {
    QFETCH(float, brightness);
    const Prepared p(SceneSettings{});
    image::Image content = makeContent(Content::natural, {40, 30}, 1);
    for (float& value : content.data()) value *= brightness;
    const Target target = fitTarget(content, p.venue, {});
    const Compensator compensator(p.venue, p.inverse);
    CompensatorSettings settings;
    settings.optimum.mostIterations = 3000;
    settings.optimum.tolerance = 1e-7;
    const Compensator thorough(p.venue, p.inverse, settings);
    const auto seenOf = [&](const Compensator& by) {
      return p.venue.transport.apply(by.solve(Method::optimum, target, quiet).projector);
    };
    const CameraStack is = seenOf(compensator), end = seenOf(thorough);
    double apart = 0.0, light = 0.0;
    for (std::size_t i = 0; i < is.size(); ++i) {
      const auto weight = static_cast<double>(target.weight[i / 3]);
      apart += weight * std::pow(static_cast<double>(is[i] - end[i]), 2);
      light += weight * std::pow(static_cast<double>(end[i]), 2);
    }
    const double share = std::sqrt(apart / light);
    // The dark has its limits in more places; half of a code of 8 bits at a hundredth of white is 0.2 of it.
    QVERIFY2(share < 0.06, qPrintable(QString::number(share)));
  }

  void stepsLetNothingGrow() {
    double largest = 0.0;
    for (double s = 0.0; s <= 1.0; s += 1e-3) {
      double left = 1.0;
      for (float step : CompensatorSettings{}.steps) {
        left *= 1.0 - static_cast<double>(step) * s;
        largest = std::max(largest, std::abs(left));
      }
    }
    QVERIFY2(largest <= 1.0, qPrintable(QString::number(largest)));
  }

  void checksSettings() {
    QVERIFY(problems(CompensatorSettings{}).empty());
    CompensatorSettings wrong;
    wrong.correctionByAdjoint = -1.0f;
    wrong.steps = {0.0f};
    QCOMPARE(problems(wrong).size(), std::size_t{2});
  }
};

QTEST_APPLESS_MAIN(TestMethods)
#include "test_methods.moc"
