// SPDX-License-Identifier: MIT
#include "relucent/engine/view_follower.h"

#include "core/engine/engine_backends.h"
#include "relucent/compensation/solver.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::image;
using namespace relucent::synthetic;

namespace {

constexpr Size size{37, 28};

using Weights = std::vector<double>;

TargetSettings weighted(TargetSettings settings, const Weights& weights) {
  settings.views.resize(weights.size());
  for (std::size_t view = 0; view < weights.size(); ++view) settings.views[view].weight = weights[view];
  return settings;
}

/// As back ends have it before dithering, in codes.
std::vector<std::uint32_t> words(EngineBackend& backend, const ContentFrame& frame,
                                 const FrameRequest& request, std::size_t pixels) {
  std::vector<std::uint32_t> result(pixels);
  FrameReport report;
  if (!backend.render(frame, request, result, report)) result.clear();
  return result;
}

void everyBackendForViewers() {
  QTest::addColumn<QString>("backend");
  QTest::addColumn<QString>("scene");
  for (const NamedBackend& backend : backends())
    for (const char* scene : {"several views", "two views", "own pictures"})
      QTest::addRow("%s, %s", backend.name.c_str(), scene) << QString::fromStdString(backend.name) << scene;
}

}  // namespace

class TestViewFollower : public QObject {
  Q_OBJECT

 private slots:
  void equalsAFreshPreparation_data() {
    QTest::addColumn<QString>("scene");
    for (const char* scene : {"several views", "two views", "own pictures"}) QTest::newRow(scene) << scene;
  }
  /// Whoever has walked anywhere finds what is prepared for him there, bit by bit; and at home again, what
  /// was there before.
  void equalsAFreshPreparation() {
    QFETCH(QString, scene);
    const EngineScene made = engineSceneOf(scene.toStdString());
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    EngineContent content = prepareContent(engine, size);
    ViewFollower follower(engine, content);
    for (const Weights& weights : {Weights{0.3, 0.7}, Weights{1.0, 0.0}, Weights{0.0, 0.25},
                                   Weights{0.5, 0.5}, Weights{1e-3, 1.0}, Weights{0.3, 0.7}}) {
      follower.follow(weights, content);
      EngineSettings settings = exact(made);
      settings.target = weighted(made.target, weights);
      const EngineVenue there = prepareVenue(made.venue, made.inverse, made.responses, settings);
      const EngineContent fresh = prepareContent(there, size);
      QCOMPARE(content.white, fresh.white);
      QVERIFY(content.viewWeight == fresh.viewWeight && content.weight == fresh.weight);
      QVERIFY(content.free == fresh.free && content.brightest == fresh.brightest && content.lit == fresh.lit);
    }
  }

  void equalsTheSolverWithTheseWeights_data() { everyBackendForViewers(); }
  /// From the beginning, as refined with these weights; and on from there for other weights, as its steps
  /// are.
  void equalsTheSolverWithTheseWeights() {
    QFETCH(QString, backend);
    QFETCH(QString, scene);
    SKIP_WHERE_MISSING(backend);
    const EngineScene made = engineSceneOf(scene.toStdString());
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    const std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    const Image picture = makeContent(Content::natural, size, 3);
    EngineContent content = prepareContent(engine, size);
    ViewFollower follower(engine, content);
    device->setContent(content);
    // As in test_backends.
    const double tolerance = scene.startsWith("several") ? 6.0 : 1.5;
    Progress silent;

    Weights weights{0.8, 0.2};
    follower.follow(weights, content);
    device->contentFollowed();
    Target target = fitTarget(picture, made.venue, weighted(made.target, weights));
    CompensatorSettings settings;
    settings.steps.resize(2);
    const Compensator compensator(made.venue, made.inverse, settings);
    ProjectorStack expected = compensator.solve(Method::refined, target, silent).projector;
    FrameRequest request{true, 2, 1.0f, 0.0f};
    std::vector<std::uint32_t> seen = words(*device, frameOf(picture), request, engine.brightest.size());
    QVERIFY2(mostCodesApart(seen, expected) <= tolerance,
             qPrintable(QString::number(mostCodesApart(seen, expected))));

    request.fromLast = true;
    const std::vector<float> lengths = CompensatorSettings().steps;
    for (const Weights& next : {Weights{0.5, 0.5}, Weights{0.1, 0.9}, Weights{0.0, 1.0}, Weights{0.0, 1.0}}) {
      follower.follow(next, content);
      device->contentFollowed();
      target = fitTarget(picture, made.venue, weighted(made.target, next));
      const ProjectorMask free = compensator.contentPixelsOf(target);
      for (std::size_t i = 0; i < expected.size(); ++i)
        if (!free[i / 3]) expected[i] = 0.0f;
      CameraStack wanted = target.wanted;
      for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] -= made.venue.black[i];
      const ConstrainedProblem problem{made.venue.transport, wanted, target.weight, free};
      const ProjectorStack c = engine.preconditioner.of(problem);
      for (int step = 0; step < 2; ++step) {
        takeStep(problem, c, lengths[static_cast<std::size_t>(step)], expected);
        for (std::size_t i = 0; i < expected.size(); ++i)
          expected[i] = free[i / 3] ? std::clamp(expected[i], 0.0f, 1.0f) : 0.0f;
      }
      seen = words(*device, frameOf(picture), request, engine.brightest.size());
      const double apart = mostCodesApart(seen, expected);
      QVERIFY2(apart <= tolerance, qPrintable(QString("%1 codes").arg(apart)));
    }
  }

  void aViewerWhoIsHomeHasTheBitsOfBefore_data() { everyBackendForViewers(); }
  void aViewerWhoIsHomeHasTheBitsOfBefore() {
    QFETCH(QString, backend);
    QFETCH(QString, scene);
    SKIP_WHERE_MISSING(backend);
    const EngineScene made = engineSceneOf(scene.toStdString());
    EngineSettings settings;
    settings.target = made.target;
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, settings);
    const std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    const Image picture = makeContent(Content::saturated, size, 5);
    EngineContent content = prepareContent(engine, size);
    const Weights home = [&] {
      Weights weights;
      for (std::size_t view = 0; view < 2; ++view)
        weights.push_back(view < made.target.views.size() ? made.target.views[view].weight : 1.0);
      return weights;
    }();
    device->setContent(content);
    for (const bool compensated : {true, false}) {
      const FrameRequest request{compensated, 2, 0.9f, 0.02f};
      const auto before = words(*device, frameOf(picture), request, engine.brightest.size());
      ViewFollower follower(engine, content);
      for (const Weights& weights : {Weights{0.2, 0.8}, Weights{0.0, 1.0}, home}) {
        follower.follow(weights, content);
        device->contentFollowed();
        FrameRequest walking = request;
        walking.fromLast = true;
        const auto there = words(*device, frameOf(picture), walking, engine.brightest.size());
        QVERIFY(!there.empty());
        QVERIFY(weights == home || mostApart(there, before) > 0);
      }
      QVERIFY(words(*device, frameOf(picture), request, engine.brightest.size()) == before);
    }
  }

  void goesOnFromWhatItIsGiven_data() { everyBackend(); }
  /// Without steps what it starts from is what is shown; with many, the same as without.
  void goesOnFromWhatItIsGiven() {
    QFETCH(QString, backend);
    SKIP_WHERE_MISSING(backend);
    const EngineScene made = engineSceneOf("two views");
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    const std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    const Image picture = makeContent(Content::natural, size, 3);
    EngineContent content = prepareContent(engine, size);
    device->setContent(content);
    // Where there is nothing to go on from it begins.
    FrameRequest request{true, 2, 1.0f, 0.0f};
    const auto begun = words(*device, frameOf(picture), request, engine.brightest.size());
    device->setContent(content);
    request.fromLast = true;
    QVERIFY(words(*device, frameOf(picture), request, engine.brightest.size()) == begun);

    ProjectorStack start(3 * engine.brightest.size());
    for (std::size_t i = 0; i < start.size(); ++i)
      start[i] = content.free[i / 3] ? static_cast<float>(i % 256) / 255.0f : 0.0f;
    device->startFrom(start);
    request.steps = 0;
    QVERIFY(mostCodesApart(words(*device, frameOf(picture), request, engine.brightest.size()), start) < 0.6);
    // As near in the end as from the beginning.
    const Target target = fitTarget(picture, made.venue, made.target);
    const auto errorOf = [&](const std::vector<std::uint32_t>& shown) {
      ProjectorStack projector(start.size());
      for (std::size_t i = 0; i < projector.size(); ++i)
        projector[i] = static_cast<float>(codeOf(shown[i / 3], i % 3)) / 255.0f;
      const CameraStack light = made.venue.transport.apply(projector);
      double sum = 0.0;
      for (std::size_t i = 0; i < light.size(); ++i)
        sum += static_cast<double>(target.weight[i / 3]) *
               std::pow(static_cast<double>(light[i] + made.venue.black[i] - target.wanted[i]), 2);
      return sum;
    };
    device->setContent(content);
    request = {true, 12, 1.0f, 0.0f};
    const double refined = errorOf(words(*device, frameOf(picture), request, engine.brightest.size()));
    device->startFrom(start);
    request.fromLast = true;
    double error = 0.0;
    for (int frame = 0; frame < 12; ++frame)
      error = errorOf(words(*device, frameOf(picture), request, engine.brightest.size()));
    QVERIFY2(error < 1.05 * refined, qPrintable(QString("%1 of %2").arg(error).arg(refined)));
  }

  /// Law: where a camera stands its view has nearly all, nobody ever nothing; without presence it is home.
  void weightsOfAFollowedViewer() {
    const EngineScene made = engineSceneOf("two views");
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    const EngineContent content = prepareContent(engine, size);
    const ViewFollower follower(engine, content);
    const std::vector<Position> cameras{{0, 0, 0}, {2, 0, 0}};
    const Weights home{1.0, 0.5};
    const auto at = [&](double x, double presence) {
      return follower.weightsFor(cameras, home, home, {x, 0, 0}, presence);
    };
    const auto near = [](double a, double b) { return std::abs(a - b) < 2e-3; };
    QVERIFY(near(at(0, 1)[0], 1.0) && at(0, 1)[1] > 1e-4 && near(at(2, 1)[1], 1.0) && at(2, 1)[0] > 1e-4);
    QVERIFY(near(at(1, 1)[0], 2.0 / 3.0) && near(at(1, 1)[1], 1.0 / 3.0));
    QVERIFY(near(at(2, 0)[0], 2.0 / 3.0) && near(at(2, 0.5)[0], 1.0 / 3.0));
    const Weights second{0.0, 1.0};
    QVERIFY(follower.weightsFor(cameras, second, second, {0, 0, 0}, 1.0).empty());
    // Home may be a sweet spot, to which he goes back.
    const Weights rest = followedWeights(cameras, home, {2, 0, 0});
    const std::vector<double> gone = follower.weightsFor(cameras, home, rest, {0, 0, 0}, 0.0);
    QVERIFY(near(gone[0], rest[0]) && near(gone[1], rest[1]) && gone[0] > 1e-4);
  }

  /// Where content lies in no other view, nobody can walk there.
  void whichViewsCanBeFollowed() {
    for (const auto& [scene, second] :
         std::vector<std::pair<const char*, bool>>{{"several devices", false}, {"several views", true}}) {
      const EngineScene made = engineSceneOf(scene);
      const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
      EngineContent content = prepareContent(engine, size);
      ViewFollower follower(engine, content);
      QVERIFY(follower.shows(0));
      QCOMPARE(follower.shows(1), second);
      if (!second) QVERIFY_THROWS_EXCEPTION(Error, follower.follow(Weights{0.0, 1.0}, content));
    }
  }

  void refusesWhatAreNoWeights() {
    const EngineScene made = engineSceneOf("two views");
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    EngineContent content = prepareContent(engine, size);
    ViewFollower follower(engine, content);
    QVERIFY_THROWS_EXCEPTION(std::logic_error, follower.follow(Weights{1.0}, content));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, follower.follow(Weights{0.0, 0.0}, content));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, follower.follow(Weights{}, content));
  }
};

QTEST_APPLESS_MAIN(TestViewFollower)
#include "test_view_follower.moc"
