// SPDX-License-Identifier: MIT
// Frames with parts of the view that are not to be lit.
#include "core/engine/engine_backends.h"
#include "relucent/engine/availability.h"
#include "relucent/engine/view_follower.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::image;
using namespace relucent::synthetic;
using namespace std::chrono_literals;

namespace {

constexpr Size size{37, 28};

Mask door(double feather) {
  return {0, Outline::lines, {{0.4, 0.3}, {0.6, 0.3}, {0.6, 0.7}, {0.4, 0.7}}, feather};
}

void everyBackendAndVenue() {
  QTest::addColumn<QString>("backend");
  QTest::addColumn<QString>("scene");
  for (const NamedBackend& backend : backends())
    for (const char* scene : {"several devices", "two views", "wall", "light"})
      QTest::addRow("%s, %s", backend.name.c_str(), scene) << QString::fromStdString(backend.name) << scene;
}

}  // namespace

class TestEngineMasks : public QObject {
  Q_OBJECT

 private slots:
  void framesEqualTheMethods_data() { everyBackendAndVenue(); }
  void framesEqualTheMethods() {
    QFETCH(QString, backend);
    QFETCH(QString, scene);
    SKIP_WHERE_MISSING(backend);
    EngineScene made = engineSceneOf(scene.toStdString());
    made.target.masks = {door(0.1)};
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    const std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    const Image picture = makeContent(Content::natural, size, 3);
    const Target target = fitTarget(picture, made.venue, made.target);
    QVERIFY(std::ranges::count(target.available, 0.0f) > 3);
    Progress silent;
    const double tolerance = scene.startsWith("several") ? 6.0 : 1.0;  // as test_backends
    for (int steps : {0, 2}) {
      CompensatorSettings settings;
      settings.steps.resize(static_cast<std::size_t>(steps));
      const Compensation expected =
          Compensator(made.venue, made.inverse, settings)
              .solve(steps == 0 ? Method::windows : Method::refined, target, silent);
      const double apart = mostCodesApart(
          rendered(*device, engine, frameOf(picture), {true, steps, 1.0f, 0.0f}), expected.projector);
      QVERIFY2(apart <= tolerance, qPrintable(QString("K = %1: %2 codes").arg(steps).arg(apart)));
    }
    // Nothing corrected: masked all the same. Of light that nobody sees (several devices), the target takes
    // a's share out of its flood, and content has none of it.
    const Compensation none = Compensator(made.venue, made.inverse).solve(Method::none, target, silent);
    const double apart =
        mostCodesApart(rendered(*device, engine, frameOf(picture), {false, 0, 1.0f, 0.0f}), none.projector);
    QVERIFY2(apart <= (scene.startsWith("several") ? 2.0 : 1.0), qPrintable(QString("%1 codes").arg(apart)));
  }

  /// Law: content prepared by a target, after any other's, is as in a venue that was prepared for it alone.
  void targetsInTurnAreAsIfAlone_data() {
    QTest::addColumn<QString>("backend");
    QTest::addColumn<QString>("scene");
    for (const NamedBackend& backend : backends())
      for (const char* scene : {"two views", "light"})
        QTest::addRow("%s, %s", backend.name.c_str(), scene) << QString::fromStdString(backend.name) << scene;
  }
  void targetsInTurnAreAsIfAlone() {
    QFETCH(QString, backend);
    QFETCH(QString, scene);
    SKIP_WHERE_MISSING(backend);
    const EngineScene made = engineSceneOf(scene.toStdString());
    std::vector<TargetSettings> targets(3, made.target);
    targets[1].masks = {door(0.1)};
    targets[1].reachablePercentile = 40.0;
    targets[1].objective = Objective::light;
    targets[2].clipping = Clipping::hue;
    targets[2].blackLift = 0.05;
    const EngineVenue shared = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    const std::unique_ptr<EngineBackend> device = backendOf(backend, shared);
    const Image picture = makeContent(Content::natural, size, 3);
    std::vector<EngineContent> contents;
    for (const TargetSettings& target : targets) contents.push_back(prepareContent(shared, size, target));
    const auto frameBy = [&](std::size_t target) {
      device->setContent(contents[target]);
      std::vector<std::uint32_t> words(shared.brightest.size());
      FrameReport report;
      return device->render(frameOf(picture), {true, 2, 1.0f, 0.0f}, words, report)
                 ? words
                 : std::vector<std::uint32_t>();
    };
    for (std::size_t target : {1u, 2u, 0u}) {
      EngineScene alone = made;
      alone.target = targets[target];
      const EngineVenue own = prepareVenue(made.venue, made.inverse, made.responses, exact(alone));
      const std::unique_ptr<EngineBackend> itself = backendOf(backend, own);
      QVERIFY(frameBy(target) == rendered(*itself, own, frameOf(picture), {true, 2, 1.0f, 0.0f}));
    }
    QVERIFY(frameBy(0) != frameBy(1) && frameBy(0) != frameBy(2));
  }

  void shadowsAndMasksAreOneProduct_data() { everyBackendAndVenue(); }
  void shadowsAndMasksAreOneProduct() {
    QFETCH(QString, backend);
    QFETCH(QString, scene);
    SKIP_WHERE_MISSING(backend);
    EngineScene made = engineSceneOf(scene.toStdString());
    made.target.masks = {door(0.1)};
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    const std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    const Image picture = makeContent(Content::saturated, size, 5);
    EngineContent content = prepareContent(engine, size);
    device->setContent(content);
    AvailabilityFollower follower(engine);
    const auto frame = [&] {
      std::vector<std::uint32_t> words(engine.brightest.size());
      FrameReport report;
      return device->render(frameOf(picture), {true, 2, 1.0f, 0.0f}, words, report)
                 ? words
                 : std::vector<std::uint32_t>();
    };
    const auto before = frame();
    Availability half, all;
    for (const Size& projector : engine.venue.transport.projectors().sizes()) {
      half.projectors.push_back(completeGrid(projector, 4));
      std::ranges::fill(half.projectors.back().share, 0.5f);
      all.projectors.push_back(completeGrid(projector, 4));
    }
    follower.aim(half, content);
    QVERIFY(follower.advance(10s, content) && !follower.isComplete());
    device->availabilityFollowed();
    for (std::size_t j = 0; j < content.kept.size(); ++j)
      QCOMPARE(content.available[j], 0.5f * content.kept[j]);
    const auto there = frame();
    QVERIFY(there != before);
    for (std::size_t j = 0; j < there.size(); ++j)
      for (std::size_t c = 0; c < 3; ++c)
        QVERIFY(codeOf(there[j], c) <= 127.5 * static_cast<double>(content.kept[j]) + 1.0);
    follower.aim(all, content);
    for (int n = 0; n < 40 && !follower.settled(); ++n)
      if (follower.advance(20ms, content)) device->availabilityFollowed();
    QVERIFY(follower.isComplete() && content.available == content.kept);
    QVERIFY(frame() == before);

    // A solution of which masks have taken their share already is taken as it is.
    ProjectorStack start(3 * content.kept.size());
    for (std::size_t i = 0; i < start.size(); ++i)
      start[i] = content.free[i / 3] ? static_cast<float>(i % 7) / 7.0f * content.kept[i / 3] : 0.0f;
    device->startFrom(start);
    std::vector<std::uint32_t> words(engine.brightest.size());
    FrameReport report;
    QVERIFY(device->render(frameOf(picture), {true, 0, 1.0f, 0.0f, true}, words, report));
    QVERIFY(mostCodesApart(words, start) < 0.6);
  }

  /// Whoever walks on finds the same light as with content that is prepared for him.
  void viewersWalkWithMasks() {
    EngineScene made = engineSceneOf("two views");
    made.target.masks = {door(0.1)};
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    EngineContent content = prepareContent(engine, size);
    ViewFollower follower(engine, content);
    follower.follow(std::vector<double>{0.2, 1.0}, content);
    TargetSettings settings = made.target;
    settings.views = {{0.2, {}, {}}, {1.0, {}, {}}};
    EngineSettings other = exact(made);
    other.target = settings;
    const EngineVenue his = prepareVenue(made.venue, made.inverse, made.responses, other);
    const EngineContent expected = prepareContent(his, size);
    QVERIFY(content.weight == expected.weight && content.free == expected.free &&
            content.lit == expected.lit);
    QVERIFY(content.missing == expected.missing && content.available == expected.available);
    QCOMPARE(content.white, expected.white);
  }
};

QTEST_GUILESS_MAIN(TestEngineMasks)
#include "test_engine_masks.moc"
