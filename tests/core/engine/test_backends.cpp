// SPDX-License-Identifier: MIT
#include <tbb/global_control.h>

#include <QtTest>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>

#include "core/engine/engine_backends.h"
#include "relucent/base/error.h"
#include "relucent/image/colour.h"

namespace {
std::atomic<std::size_t> allocations{0};

}  // namespace

// Every allocation of the program is counted: a frame must make none.
namespace {
void* counted(std::size_t bytes) {
  ++allocations;
  if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t bytes) {
  return counted(bytes);
}
void* operator new[](std::size_t bytes) {
  return counted(bytes);
}
// A sanitizer's own would not call those.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(bytes > 0 ? bytes : 1);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(bytes > 0 ? bytes : 1);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

using namespace relucent;
using namespace relucent::clustering;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::image;
using namespace relucent::inverse;
using namespace relucent::linearization;
using namespace relucent::transport;
using namespace relucent::synthetic;

namespace {

/// Mean squared error of what T makes of a projection, over what can be reached.
double errorSeen(const MeasuredVenue& venue, const Target& target, const ProjectorStack& projector) {
  CameraStack seen = venue.transport.apply(projector);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!target.reachable[i / 3]) continue;
    sum += std::pow(static_cast<double>(seen[i] + venue.black[i] - target.wanted[i]), 2);
    count += 1.0;
  }
  return sum / count;
}

/// The gains that fitTarget() finds.
BrightnessField fieldOf(const Target& target, const EngineVenue& engine, const Image& content) {
  const MeasuredVenue& venue = engine.venue;
  const EngineContent placed = prepareContent(engine, content.size());
  BrightnessSamples samples(venue, target.inside, placed.weight, placesInContent(venue, target),
                            target.white[0]);
  const BrightnessFit fit(Brightness::region, static_cast<double>(content.width()) / content.height());
  return fit.fit(samples.of([&](std::size_t i) {
    const Eigen::Vector3f mixed = engine.mixing * Eigen::Map<const Eigen::Vector3f>(&target.content[3 * i]);
    return std::array{mixed[0], mixed[1], mixed[2]};
  }));
}

}  // namespace

class TestBackends : public QObject {
  Q_OBJECT

 private slots:
  void equalsTheMethods_data() { everyBackendInEveryScene(); }
  /// K = 0 is the method windows, K = n is refined with its first n steps.
  void equalsTheMethods() {
    QFETCH(QString, backend);
    SKIP_WHERE_MISSING(backend);
    QFETCH(QString, scene);
    EngineScene made = engineSceneOf(scene.toStdString());
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    Image content = makeContent(Content::natural, {37, 28}, 3);
    Target target = fitTarget(content, made.venue, made.target);
    Progress silent;
    // Half a code for rounding, and what the codes of T and M leave: see test_packed_transport. In "several
    // devices" light of different colours meets in a pixel, which the packed T knows by its mean mixing only.
    double tolerance = scene.startsWith("several") ? 6.0 : 1.0;
    for (int steps : {0, 1, 2, 6}) {
      CompensatorSettings settings;
      settings.steps.resize(static_cast<std::size_t>(steps));
      Compensation expected = Compensator(made.venue, made.inverse, settings)
                                  .solve(steps == 0 ? Method::windows : Method::refined, target, silent);
      FrameReport report;
      std::vector<std::uint32_t> words =
          rendered(*device, engine, frameOf(content), {true, steps, 1.0f, 0.0f}, &report);
      double apart = mostCodesApart(words, expected.projector);
      QVERIFY2(apart <= tolerance, qPrintable(QString("K = %1: %2 codes").arg(steps).arg(apart)));
      QCOMPARE(report.steps, steps);
      QVERIFY(std::abs(report.clipped - expected.clipped) < 0.02);
    }
  }

  void partsAreTheWhole_data() {
    QTest::addColumn<QString>("scene");
    for (const std::string& scene : engineSceneNames())
      QTest::newRow(scene.c_str()) << QString::fromStdString(scene);
  }
  /// Law: what a graphics card cannot reach at once it is given in parts, and the frames are the same bits.
  void partsAreTheWhole() {
    SKIP_WHERE_MISSING(QString("OpenGL"));
    QFETCH(QString, scene);
    constexpr std::size_t most = 1024;  // bytes: some parts hold one of what they hold parts of
    const EngineScene made = engineSceneOf(scene.toStdString());
    const EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, plain(made));
    const Image content = makeContent(Content::natural, {37, 28}, 3);
    OpenGlBackend whole(engine, std::make_unique<GlContext>(GlContext::Device::any)),
        inParts(engine, std::make_unique<GlContext>(GlContext::Device::any), most);
    for (const FrameRequest& request : {FrameRequest{true, 0, 1.0f, 0.0f}, FrameRequest{true, 2, 1.0f, 0.0f}})
      QVERIFY(rendered(inParts, engine, frameOf(content), request) ==
              rendered(whole, engine, frameOf(content), request));
    // Brightness of uncorrected content is a sum, in another order.
    const FrameRequest off{false, 0, 1.0f, 0.0f};
    QVERIFY(mostApart(rendered(inParts, engine, frameOf(content), off),
                      rendered(whole, engine, frameOf(content), off)) <= 1);
  }

  void gainsAreTheTargets_data() { everyBackendInEveryScene(); }
  /// With the gains of white that the target has, too; and without them as before.
  void gainsAreTheTargets() {
    QFETCH(QString, backend);
    SKIP_WHERE_MISSING(backend);
    QFETCH(QString, scene);
    EngineScene made = engineSceneOf(scene.toStdString());
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact(made));
    std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    Image content = makeContent(Content::natural, {40, 30}, 3);
    for (float& value : content.data()) value *= 0.05f;  // so dark that white is made brighter
    TargetSettings settings = made.target;
    settings.brightness = Brightness::region;
    const Target target = fitTarget(content, made.venue, settings);
    const BrightnessField field = fieldOf(target, engine, content);
    double most = 0.0;
    for (float octaves : field.octaves) most = std::max(most, std::abs(static_cast<double>(octaves)));
    Progress silent;
    const double tolerance = scene.startsWith("several") ? 6.0 : 1.0;  // as equalsTheMethods()
    for (int steps : {0, 2}) {
      CompensatorSettings compensator;
      compensator.steps.resize(static_cast<std::size_t>(steps));
      const Compensation expected =
          Compensator(made.venue, made.inverse, compensator)
              .solve(steps == 0 ? Method::windows : Method::refined, target, silent);
      FrameRequest request{true, steps, 1.0f, 0.0f};
      const auto even = rendered(*device, engine, frameOf(content), request);
      request.field = &field;
      const auto words = rendered(*device, engine, frameOf(content), request);
      const double apart = mostCodesApart(words, expected.projector);
      QVERIFY2(apart <= tolerance, qPrintable(QString("K = %1: %2 codes").arg(steps).arg(apart)));
      QVERIFY(most < 0.1 || mostApart(words, even) > 1);
      request.field = nullptr;
      QVERIFY(rendered(*device, engine, frameOf(content), request) == even);
    }
  }

  void agrees_data() { everyBackendInEveryScene(); }
  /// Back ends differ in roundings only, which change a code by one at the most, dithered or not.
  void agrees() {
    QFETCH(QString, backend);
    QFETCH(QString, scene);
    SKIP_WHERE_MISSING(backend);
    EngineScene made = engineSceneOf(scene.toStdString());
    for (int bits : {8, 10}) {
      EngineSettings settings;
      settings.target = made.target;
      settings.bits = bits;
      settings.dither = bits == 8 ? Dither::blueNoise : Dither::ordered;
      settings.packing.patchSide = 16;
      EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, settings);
      CpuBackend reference(engine, &engineKernels().front());
      std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
      Image content = makeContent(Content::saturated, {53, 40}, 6);
      // So bright that some of it cannot be reached, most of it, or nothing.
      for (const auto& [steps, brightness] : std::vector<std::pair<int, float>>{
               {-1, 0.9f}, {0, 0.9f}, {1, 0.9f}, {2, 0.9f}, {1, 4.0f}, {1, 1e4f}}) {
        const FrameRequest request{steps >= 0, steps, brightness, 0.05f};
        FrameReport report, expected;
        auto words = rendered(*device, engine, frameOf(content), request, &report);
        int apart = mostApart(words, rendered(reference, engine, frameOf(content), request, &expected), bits);
        QVERIFY2(apart <= 1, qPrintable(QString("%1 bits, K = %2: %3").arg(bits).arg(steps).arg(apart)));
        // A value that lies on the border of what is visibly cut may fall to either side.
        QVERIFY(std::abs(report.clipped - expected.clipped) < 0.01);
      }
    }
  }

  void qualityOfTheMethods_data() { everyBackendInEveryScene(); }
  /// What T makes of the engine's picture is as near to what was wanted as what it makes of the method's.
  void qualityOfTheMethods() {
    QFETCH(QString, backend);
    SKIP_WHERE_MISSING(backend);
    QFETCH(QString, scene);
    EngineScene made = engineSceneOf(scene.toStdString());
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, plain(made));
    std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    Image content = makeContent(Content::saturated, {24, 18}, 8);
    Target target = fitTarget(content, made.venue, made.target);
    if (std::count(target.reachable.begin(), target.reachable.end(), 1) == 0) return;
    Progress silent;
    CompensatorSettings settings;
    settings.steps.resize(2);
    ProjectorStack expected =
        Compensator(made.venue, made.inverse, settings).solve(Method::refined, target, silent).projector;
    std::vector<std::uint32_t> words = rendered(*device, engine, frameOf(content), {true, 2, 1.0f, 0.0f});
    ProjectorStack projector(expected.size());
    for (std::size_t i = 0; i < projector.size(); ++i)
      projector[i] = static_cast<float>(codeOf(words[i / 3], i % 3)) / 255.0f;
    // Rounding to codes is part of both.
    for (float& value : expected) value = std::round(255.0f * value) / 255.0f;
    double loss =
        10.0 * std::log10(errorSeen(made.venue, target, projector) / errorSeen(made.venue, target, expected));
    QVERIFY2(loss <= 0.2, qPrintable(QString("%1 dB").arg(loss)));
  }

  void warpsOnlyWhenNotCompensating_data() { everyBackendInEveryScene(); }
  void warpsOnlyWhenNotCompensating() {
    QFETCH(QString, backend);
    SKIP_WHERE_MISSING(backend);
    QFETCH(QString, scene);
    EngineScene made = engineSceneOf(scene.toStdString());
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, plain(made));
    std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    Image content = makeContent(Content::natural, {40, 30}, 1);
    Target target = fitTarget(content, made.venue, made.target);
    Progress silent;
    ProjectorStack expected =
        Compensator(made.venue, made.inverse).solve(Method::none, target, silent).projector;
    std::vector<std::uint32_t> words = rendered(*device, engine, frameOf(content), {false, 2, 1.0f, 0.0f});
    // Half a code for rounding, and weights of 16 bits.
    QVERIFY(mostCodesApart(words, expected) <= 0.6);
  }

  void formatsShowTheSame_data() { everyBackend(); }
  void formatsShowTheSame() {
    QFETCH(QString, backend);
    SKIP_WHERE_MISSING(backend);
    EngineScene made = engineSceneOf("wall");
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, plain());
    std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    const Size size{19, 14};
    Random random{5};
    constexpr std::size_t padding = 5;  // lines need not follow each other at once
    std::size_t line3 = 3 * 19 + padding, line4 = 4 * 19 + padding;
    std::vector<std::uint8_t> rgb(14 * line3), rgba(14 * line4), bgra(14 * line4);
    Image linear(size, 3);
    for (std::size_t y = 0; y < 14; ++y) {
      for (std::size_t x = 0; x < 19; ++x) {
        for (std::size_t c = 0; c < 3; ++c) {
          auto code = static_cast<std::uint8_t>(random.below(256));
          rgb[y * line3 + 3 * x + c] = rgba[y * line4 + 4 * x + c] = bgra[y * line4 + 4 * x + 2 - c] = code;
          linear.at(static_cast<int>(x), static_cast<int>(y), static_cast<int>(c)) =
              static_cast<float>(srgbDecode(code / 255.0));
        }
      }
    }
    FrameRequest request;
    auto expected = rendered(*device, engine, frameOf(linear), request);
    QVERIFY(
        mostApart(rendered(*device, engine, {rgb.data(), size, line3, ContentFrame::Format::rgb8}, request),
                  expected) == 0);
    QVERIFY(
        mostApart(rendered(*device, engine, {rgba.data(), size, line4, ContentFrame::Format::rgba8}, request),
                  expected) == 0);
    QVERIFY(
        mostApart(rendered(*device, engine, {bgra.data(), size, line4, ContentFrame::Format::bgra8}, request),
                  expected) == 0);
  }

  void contentThatIsNoLight_data() { everyBackend(); }
  /// What is no number is black, what is beyond the range is cut off.
  void contentThatIsNoLight() {
    QFETCH(QString, backend);
    SKIP_WHERE_MISSING(backend);
    EngineScene made = engineSceneOf("wall");
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, {});
    std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    Image wild(Size{7, 5}, 3, 0.5f), tame = wild;
    wild.at(1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
    wild.at(2, 2, 1) = std::numeric_limits<float>::infinity();
    wild.at(3, 3, 2) = -std::numeric_limits<float>::infinity();
    wild.at(4, 1, 0) = -7.0f;
    wild.at(5, 1, 1) = 1e30f;
    tame.at(1, 1, 0) = tame.at(3, 3, 2) = tame.at(4, 1, 0) = 0.0f;
    tame.at(2, 2, 1) = tame.at(5, 1, 1) = 1.0f;
    auto expected = rendered(*device, engine, frameOf(tame), {});
    QVERIFY(rendered(*device, engine, frameOf(wild), {}) == expected);
  }

  void oddContent_data() { everyBackend(); }
  /// Content of a single pixel, of one line, larger than the view, changed in between.
  void oddContent() {
    QFETCH(QString, backend);
    SKIP_WHERE_MISSING(backend);
    EngineScene made = engineSceneOf("wall");
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, exact());
    std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    Compensator compensator(made.venue, made.inverse);
    Progress silent;
    for (Size size : {Size{1, 1}, Size{12, 2}, Size{700, 500}, Size{40, 30}}) {
      Image content = makeContent(Content::natural, size, 9);
      Target target = fitTarget(content, made.venue, {});
      ProjectorStack expected = compensator.solve(Method::windows, target, silent).projector;
      auto words = rendered(*device, engine, frameOf(content), {true, 0, 1.0f, 0.0f});
      QVERIFY2(mostCodesApart(words, expected) <= 1.0,
               qPrintable(QString("%1x%2").arg(size.width).arg(size.height)));
    }
  }

  void brightnessAndLift_data() { everyBackend(); }
  /// They are the target's own scale and offset.
  void brightnessAndLift() {
    QFETCH(QString, backend);
    SKIP_WHERE_MISSING(backend);
    EngineScene made = engineSceneOf("wall");
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, plain());
    std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    Image grey(Size{4, 3}, 3, 0.5f), dim(Size{4, 3}, 3, 0.25f), lifted(Size{4, 3}, 3, 0.6f);
    auto halved = rendered(*device, engine, frameOf(grey), {true, 1, 0.5f, 0.0f});
    QVERIFY(mostApart(halved, rendered(*device, engine, frameOf(dim), {true, 1, 1.0f, 0.0f})) <= 1);
    auto raised = rendered(*device, engine, frameOf(grey), {true, 1, 1.0f, 0.2f});
    QVERIFY(mostApart(raised, rendered(*device, engine, frameOf(lifted), {true, 1, 1.0f, 0.0f})) <= 1);

    EngineSettings settings = plain();
    settings.target.blackLift = 0.2;
    const EngineVenue lifting = prepareVenue(made.venue, made.inverse, made.responses, settings);
    const std::unique_ptr<EngineBackend> lifts = backendOf(backend, lifting);
    for (const float asked : {0.0f, 0.1f, 0.2f})
      QVERIFY(rendered(*lifts, lifting, frameOf(grey), {true, 1, 1.0f, asked}) == raised);
    QVERIFY(rendered(*lifts, lifting, frameOf(grey), {true, 1, 1.0f, 0.3f}) ==
            rendered(*device, engine, frameOf(grey), {true, 1, 1.0f, 0.3f}));
  }

  void sameBitsForEveryNumberOfThreads_data() { everyBackend(); }
  void sameBitsForEveryNumberOfThreads() {
    QFETCH(QString, backend);
    SKIP_WHERE_MISSING(backend);
    EngineScene made = engineSceneOf("defocus");
    EngineSettings settings;
    settings.packing.patchSide = 8;  // many patches
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, settings);
    std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    Image content = makeContent(Content::text, {60, 45}, 2);
    std::vector<std::uint32_t> first;
    for (std::size_t threads : {1, 2, 5}) {
      tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      auto words = rendered(*device, engine, frameOf(content), {});
      if (first.empty()) first = words;
      QVERIFY(words == first);
    }
  }

  void aFrameAllocatesNothing_data() { everyBackend(); }
  void aFrameAllocatesNothing() {
    QFETCH(QString, backend);
    SKIP_WHERE_MISSING(backend);
    EngineScene made = engineSceneOf("wall");
    EngineVenue engine = prepareVenue(made.venue, made.inverse, made.responses, {});
    std::unique_ptr<EngineBackend> device = backendOf(backend, engine);
    Image content = makeContent(Content::natural, {64, 48}, 2);
    EngineContent placed = prepareContent(engine, content.size());
    device->setContent(placed);
    std::vector<std::uint32_t> words(engine.brightest.size());
    FrameReport report;
    // Drivers compile shaders once more for the first frames that need them.
    for (bool compensated : {true, false})
      QVERIFY(device->render(frameOf(content), {compensated, 2, 1.0f, 0.0f}, words, report));
    std::size_t before = allocations;
    for (int frame = 0; frame < 5; ++frame) {
      device->render(frameOf(content), {true, frame % 3, 1.0f, 0.0f}, words, report);
      device->render(frameOf(content), {false, 0, 1.0f, 0.0f}, words, report);
    }
    QCOMPARE(allocations - before, std::size_t{0});
  }

  void refusesWhatIsNoVenue() {
    EngineScene made = engineSceneOf("wall");
    MeasuredVenue broken = made.venue;
    broken.flood[5] = std::numeric_limits<float>::quiet_NaN();
    QVERIFY_THROWS_EXCEPTION(Error, prepareVenue(broken, made.inverse, made.responses, {}));
    MeasuredVenue dark = made.venue;
    dark.usable.assign(dark.usable.size(), 0);
    EngineVenue engine = prepareVenue(dark, made.inverse, made.responses, {});
    QVERIFY_THROWS_EXCEPTION(Error, prepareContent(engine, {4, 3}));
    EngineScene other = engineSceneOf("defocus");
    QVERIFY_THROWS_EXCEPTION(std::logic_error, prepareVenue(made.venue, other.inverse, made.responses, {}));
    EngineSettings wrong;
    wrong.bits = 9;
    wrong.packing.patchSide = 0;
    QCOMPARE(problems(wrong).size(), std::size_t{2});
  }
};

QTEST_GUILESS_MAIN(TestBackends)
#include "test_backends.moc"
