// SPDX-License-Identifier: MIT
// Light that somebody stands in: frames without it.
#include "relucent/engine/availability.h"

#include "core/engine/engine_backends.h"
#include "relucent/base/random.h"
#include "relucent/compensation/solver.h"
#include "relucent/image/colour.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::image;
using namespace relucent::synthetic;
using namespace std::chrono_literals;

namespace {

constexpr Size size{37, 28};

std::vector<std::uint32_t> frameWords(EngineBackend& backend, const ContentFrame& frame,
                                      const FrameRequest& request, std::size_t pixels) {
  std::vector<std::uint32_t> result(pixels);
  FrameReport report;
  if (!backend.render(frame, request, result, report)) result.clear();
  return result;
}

Availability complete(const EngineVenue& engine) {
  Availability all;
  for (const Size& projector : engine.venue.transport.projectors().sizes())
    all.projectors.push_back(completeGrid(projector, 4));
  return all;
}

/// Some cells dark, some half, most as they are.
Availability shadowed(const EngineVenue& engine, std::uint64_t seed) {
  Availability some = complete(engine);
  Random random({seed, 0x5ad});
  for (Availability::Grid& grid : some.projectors)
    for (float& share : grid.share) {
      const double chance = random.uniform();
      share = chance < 0.3 ? 0.0f : chance < 0.4 ? 0.15f : chance < 0.5 ? 0.5f : 1.0f;
    }
  return some;
}

/// What frames ask for where not all light arrives: asked and weights as fitTarget() has them for such a
/// flood.
struct Asked {
  CameraStack light;  // less e
  std::vector<float> weight;
};
Asked askedOf(const EngineScene& made, const Target& target, const CameraStack& missing) {
  Asked asked{CameraStack(target.wanted), target.weight};
  const Rasters& cameras = made.venue.transport.cameras();
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera)
    for (std::size_t i = cameras.offset(camera); i < cameras.offset(camera) + cameras.size(camera).count();
         ++i) {
      bool reachable = true;
      double luminance = 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t k = 3 * i + c;
        const float flood = std::max(0.0f, made.venue.flood[k] - missing[k]), black = made.venue.black[k];
        reachable = reachable && target.wanted[k] >= black && target.wanted[k] <= flood + black;
        asked.light[k] = std::clamp(target.wanted[k] - black, 0.0f, flood);
        luminance += image::luminanceWeights[c] * static_cast<double>(asked.light[k] + black);
      }
      if (asked.weight[i] > 0.0f)
        asked.weight[i] = target.viewWeight[camera] * relianceOn(made.venue, i) *
                          (reachable ? 1.0f : unreachableWeightOf(made.target)) *
                          sensitivity(static_cast<float>(luminance) / target.white[0]);
    }
  return asked;
}

void everyBackendAndVenue() {
  QTest::addColumn<QString>("backend");
  QTest::addColumn<QString>("scene");
  for (const NamedBackend& backend : backends())
    for (const char* scene : {"several devices", "two views", "wall"})
      QTest::addRow("%s, %s", backend.name.c_str(), scene) << QString::fromStdString(backend.name) << scene;
}

}  // namespace

class TestAvailability : public QObject {
  Q_OBJECT

 private slots:
  void framesEqualTheSolverWithoutThatLight_data() { everyBackendAndVenue(); }
  /// The steps of min |T a p - r|, projected as a p, C of T a.
  void framesEqualTheSolverWithoutThatLight() {
    QFETCH(QString, backend);
    QFETCH(QString, scene);
    SKIP_WHERE_MISSING(backend);
    const EngineScene made = engineSceneOf(scene.toStdString());
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    const std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    const Image picture = makeContent(Content::natural, size, 3);
    EngineContent content = prepareContent(engine, size);
    device->setContent(content);
    AvailabilityFollower follower(engine);
    const Target target = fitTarget(picture, made.venue, made.target);
    const transport::TransportMatrix& transport = made.venue.transport;
    const std::size_t values = 3 * engine.brightest.size();
    // As in test_backends: rows of several mixings are one in the engine.
    const double tolerance = scene.startsWith("several") ? 6.0 : 1.5;

    for (std::uint64_t seed : {1, 2}) {
      follower.aim(shadowed(engine, seed), content);
      QVERIFY(follower.advance(10s, content) && follower.settled());
      device->availabilityFollowed();
      const std::vector<float>& a = content.available;
      ProjectorStack start(values), expected(values), lit(values);
      for (std::size_t i = 0; i < values; ++i) {
        start[i] = static_cast<float>(i % 256) / 255.0f;
        lit[i] = content.free[i / 3] ? a[i / 3] : 0.0f;
        expected[i] = lit[i] * start[i];
      }
      device->startFrom(start);
      FrameRequest request{true, 0, 1.0f, 0.0f, true};
      QVERIFY(mostCodesApart(frameWords(*device, frameOf(picture), request, values / 3), expected) < 0.6);

      const Asked asked = askedOf(made, target, content.missing);
      const auto weighted = [&](CameraStack stack) {
        for (std::size_t i = 0; i < stack.size(); ++i) stack[i] *= asked.weight[i / 3];
        return stack;
      };
      const ProjectorStack bound = transport.applyTransposed(weighted(transport.apply(lit)));
      const std::vector<float> lengths = CompensatorSettings().steps;
      for (std::size_t step = 0; step < 2; ++step) {
        CameraStack left = transport.apply(expected);
        for (std::size_t i = 0; i < left.size(); ++i) left[i] = asked.light[i] - left[i];
        const ProjectorStack back = transport.applyTransposed(weighted(left));
        for (std::size_t i = 0; i < values; ++i) {
          const std::size_t j = i / 3;
          if (!content.free[j]) continue;
          const float inverse = StepPreconditioner::inverse(bound[3 * j + 1], engine.preconditioner.least());
          const float c = a[j] * StepPreconditioner::from(engine.preconditioner.share()[i], inverse);
          expected[i] = std::clamp(expected[i] + lengths[step] * c * back[i], 0.0f, a[j]);
        }
      }
      request.steps = 2;
      device->startFrom(start);
      const double apart =
          mostCodesApart(frameWords(*device, frameOf(picture), request, values / 3), expected);
      QVERIFY2(apart <= tolerance, qPrintable(QString("%1 codes").arg(apart)));
    }
  }

  void whoeverHasGoneLeavesTheBitsOfBefore_data() { everyBackendAndVenue(); }
  void whoeverHasGoneLeavesTheBitsOfBefore() {
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
    device->setContent(content);
    AvailabilityFollower follower(engine);
    const FrameRequest request{true, 2, 0.9f, 0.02f};
    const auto frame = [&] {
      return frameWords(*device, frameOf(picture), request, engine.brightest.size());
    };
    const auto before = frame();
    follower.aim(complete(engine), content);
    if (follower.advance(20ms, content)) device->availabilityFollowed();
    QVERIFY(frame() == before && follower.settled() && content.available.empty());
    for (const std::chrono::milliseconds elapsed : {10ms, 20ms, 500ms, 2000ms}) {
      follower.aim(shadowed(engine, 7), content);
      QVERIFY(follower.advance(elapsed, content));
      device->availabilityFollowed();
      const auto there = frame();
      QVERIFY(there != before);
      for (std::size_t j = 0; j < there.size(); ++j)
        for (std::size_t c = 0; c < 3; ++c)  // dither adds a code at most
          QVERIFY(codeOf(there[j], c) <= 255.0 * static_cast<double>(content.available[j]) + 1.0);
    }
    follower.aim(complete(engine), content);
    for (int n = 0; n < 40 && !follower.settled(); ++n)
      if (follower.advance(20ms, content)) device->availabilityFollowed();
    QVERIFY(follower.settled() && content.available.empty() && content.missing.empty());
    QVERIFY(frame() == before);
  }

  /// What is missing is T of what is dimmed at every moment, which depends on the time alone, not on frames.
  void fadesAreSmoothAndConsistent() {
    const EngineScene made = engineSceneOf("several devices");
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    EngineContent slow = prepareContent(engine, size), quick = slow;
    AvailabilityFollower slowly(engine), quickly(engine);
    slowly.aim(shadowed(engine, 3), slow);
    quickly.aim(shadowed(engine, 3), quick);
    for (int n = 0; n < 5; ++n) {
      slowly.advance(20ms, slow);
      for (int part = 0; part < 4; ++part) quickly.advance(5ms, quick);
      ProjectorStack dark(3 * slow.available.size());
      for (std::size_t i = 0; i < dark.size(); ++i)
        dark[i] = slow.free[i / 3] ? 1.0f - slow.available[i / 3] : 0.0f;
      const CameraStack missing = made.venue.transport.apply(dark);
      for (std::size_t i = 0; i < missing.size(); ++i)
        QVERIFY(std::abs(missing[i] - slow.missing[i]) < 1e-4f + 1e-3f * std::abs(missing[i]));
      for (std::size_t j = 0; j < slow.available.size(); ++j)
        QVERIFY(std::abs(slow.available[j] - quick.available[j]) < 1e-4f);
    }
    // After 0.1 s all but e^-2 of the way.
    const std::vector<float> pixels = [&] {
      std::vector<float> all;
      const Availability wanted = shadowed(engine, 3);
      for (std::size_t j = 0; j < wanted.projectors.size(); ++j) {
        const auto own = sharesOfPixels(wanted.projectors[j], made.venue.transport.projectors().size(j));
        all.insert(all.end(), own.begin(), own.end());
      }
      return all;
    }();
    for (std::size_t j = 0; j < pixels.size(); ++j)
      QVERIFY(std::abs(slow.available[j] - (1.0f - (1.0f - std::exp(-2.0f)) * (1.0f - pixels[j]))) < 1e-4f);
  }

  /// Cells of one share are that share everywhere; and pixels in the middle of a cell have the cell's.
  void pixelsLieBetweenCells() {
    Availability::Grid grid = completeGrid({13, 11}, 4);
    QCOMPARE(grid.cells, (Size{4, 3}));
    for (float& share : grid.share) share = 0.35f;
    for (float share : sharesOfPixels(grid, {13, 11})) QCOMPARE(share, 0.35f);
    grid = completeGrid({15, 15}, 5);
    grid.share[indexOf(grid.cells, {1, 1})] = 0.0f;
    const std::vector<float> shares = sharesOfPixels(grid, {15, 15});
    QCOMPARE(shares[indexOf({15, 15}, {7, 7})], 0.0f);
    QCOMPARE(shares[indexOf({15, 15}, {2, 7})], 1.0f);
    QVERIFY(std::abs(shares[indexOf({15, 15}, {5, 7})] - 0.4f) < 1e-6f);
  }

  void refusesLightOfOtherProjectors() {
    const EngineScene made = engineSceneOf("wall");
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    EngineContent content = prepareContent(engine, size);
    AvailabilityFollower follower(engine);
    QVERIFY_THROWS_EXCEPTION(std::logic_error, follower.aim({}, content));
  }
};

QTEST_APPLESS_MAIN(TestAvailability)
#include "test_availability.moc"
