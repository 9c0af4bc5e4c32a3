// SPDX-License-Identifier: MIT
#include "relucent/engine/bench/engine_bench.h"

#include <epoxy/gl.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <optional>
#include <span>
#include <thread>
#include <vector>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/base/random.h"
#include "relucent/engine/availability.h"
#include "relucent/engine/bench/bench_transport.h"
#include "relucent/engine/bench/noise_content.h"
#include "relucent/engine/bench/reference_products.h"
#include "relucent/engine/cpu_backend.h"
#include "relucent/engine/opengl/gl_context.h"
#include "relucent/engine/opengl/opengl_backend.h"
#include "relucent/engine/view_follower.h"
#include "relucent/transport/files.h"

namespace relucent::engine {
namespace {

/// Seconds on the wall.
double wallClock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Seconds of this thread on a processor: on a machine that is shared, with one thread, what a part costs and
/// not how long it waits.
double threadClock() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Collects lines and knows what they are measured by.
class Bench {
 public:
  Bench(double (*seconds)(), Progress& progress) : clock_(seconds), progress_(progress) {}

  EngineBenchResult result;
  std::function<double()> clock() const { return clock_; }

  /// `run` takes the time that the clock says.
  void time(const std::string& name, double bytes, const std::function<void()>& run) {
    timeReported(name, bytes, [&] {
      const double begin = clock_();
      run();
      return clock_() - begin;
    });
  }
  /// `run` says what it took.
  void timeReported(const std::string& name, double bytes, const std::function<double()>& run) {
    progress_.checkpoint();
    EngineBenchTiming timing = timedRuns(run);
    result.lines.push_back({name, timing.median, timing.best, bytes, 0.0, {}});
  }

 private:
  double (*clock_)();
  Progress& progress_;
};

/// Bytes read and written per second by a plain copy, timed as everything else here is.
double copied(const std::function<double()>& clock) {
  constexpr std::size_t bytes = std::size_t{1} << 28;
  std::vector<char> from(bytes, 1), to(bytes, 2);
  EngineBenchTiming timing = timedRuns([&] {
    const double begin = clock();
    parallelChunks(0, bytes, 64, [&](std::size_t, std::size_t first, std::size_t end) {
      std::memcpy(&to[first], &from[first], end - first);
    });
    return clock() - begin;
  });
  return 2.0 * static_cast<double>(bytes) / timing.best;
}

[[noreturn]] void throwLost() {
  throw Error(
      ErrorKind::device,
      RELUCENT_ENGLISH_MESSAGE("engine.device-lost-while-timed", "the device was lost while it was timed"),
      RELUCENT_ENGLISH_MESSAGE("engine.try-again", "try again"));
}

void timeFrames(Bench& bench, EngineBackend& backend, const EngineVenue& engine, Size size,
                double transportBytes) {
  const NoiseContent content(size);
  std::vector<std::uint32_t> words(engine.brightest.size());
  FrameReport report;
  const auto windows = static_cast<double>(engine.inverse.bytes());
  for (int steps : {0, 1, 2})
    bench.time(fmt::format("{}: frame, K = {}", backend.name(), steps),
               2 * windows + (1 + steps) * transportBytes, [&] {
                 if (!backend.render(content.frame(), {true, steps, 1.0f, 0.0f}, words, report)) throwLost();
               });
}

/// A viewer who walks from the first camera to the second, from frame to frame.
void timeViewer(Bench& bench, EngineBackend& backend, const EngineVenue& engine, EngineContent& content,
                Size size, double transportBytes) {
  const std::size_t views = engine.venue.transport.cameras().devices();
  if (views < 2) return;
  const NoiseContent noise(size);
  std::vector<std::uint32_t> words(engine.brightest.size());
  ViewFollower follower(engine, content);
  const FrameRequest request{true, 1, 1.0f, 0.0f, true};
  FrameReport report;
  int walked = 0;
  const auto walk = [&] {
    std::vector<double> weights(views, 0.0);
    weights[0] = 0.1 + 0.01 * (walked++ % 80);
    weights[1] = 1.0 - weights[0];
    follower.follow(weights, content);
    backend.contentFollowed();
    if (!backend.render(noise.frame(), request, words, report)) throwLost();
  };
  bench.time(fmt::format("{}: viewer walks on, K = 1", backend.name()), transportBytes, walk);
}

/// Somebody walks into a projector's light: a frame while a shadow fades, and what every other shadow costs
/// besides.
void timeShadow(Bench& bench, EngineBackend& backend, const EngineVenue& engine, EngineContent& content,
                Size size, double transportBytes) {
  const Rasters& projectors = engine.venue.transport.projectors();
  if (projectors.devices() < 2) return;
  const NoiseContent noise(size);
  std::vector<std::uint32_t> words(engine.brightest.size());
  AvailabilityFollower follower(engine);
  FrameReport report;
  int walked = 0;
  const auto another = [&] {
    Availability available;
    for (const Size& projector : projectors.sizes())
      available.projectors.push_back(completeGrid(projector, std::max(2, projector.width / 32)));
    Availability::Grid& grid = available.projectors.front();
    const int left = walked++ % 20;
    for (int y = grid.cells.height / 3; y < grid.cells.height; ++y)
      for (int x = left; x < std::min(left + 5, grid.cells.width); ++x)
        grid.share[indexOf(grid.cells, {x, y})] = 0.0f;
    follower.aim(available, content);
  };
  const auto fade = [&] {
    if (follower.settled()) another();
    follower.advance(std::chrono::duration<double>(0.004), content);
    backend.availabilityFollowed();
    if (!backend.render(noise.frame(), {true, 1, 1.0f, 0.0f}, words, report)) throwLost();
  };
  bench.time(fmt::format("{}: shadow fades, K = 1", backend.name()), transportBytes, fade);
  bench.time(fmt::format("{}: another shadow", backend.name()), transportBytes, another);
  content.available.clear();
  content.missing = {};
  backend.availabilityFollowed();
}

void timeCpu(Bench& bench, const EngineVenue& engine, EngineContent& content, Size size) {
  bench.result.copyBytesPerSecond = copied(bench.clock());
  const auto transport = static_cast<double>(engine.transport.bytes());
  for (std::size_t i = engineKernels().size(); i-- > 0;) {
    CpuBackend backend(engine, &engineKernels()[i]);
    const std::string name(backend.name());
    if (bench.result.device.empty()) bench.result.device = name;
    backend.setContent(content);
    const NoiseContent noise(size);
    std::vector<std::uint32_t> words(engine.brightest.size());
    FrameReport report;
    backend.render(noise.frame(), {}, words, report);
    bench.time(name + ": M", static_cast<double>(engine.inverse.bytes()), [&] { backend.applyWindows(); });
    bench.time(name + ": step", transport, [&] { backend.takeStep(1.2f); });
    timeFrames(bench, backend, engine, size, transport);
    timeViewer(bench, backend, engine, content, size, transport);
    timeShadow(bench, backend, engine, content, size, transport);
  }
}

/// What windows take pictures from that stay on the graphics card: a texture for each projector.
class PictureTextures {
 public:
  PictureTextures(const GlContext& context, const Rasters& projectors)
      : context_(context), names_(projectors.devices()) {
    const GlContext::Current current(context_);
    glGenTextures(static_cast<GLsizei>(names_.size()), names_.data());
    for (std::size_t i = 0; i < names_.size(); ++i) {
      glBindTexture(GL_TEXTURE_2D, names_[i]);
      glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, projectors.size(i).width, projectors.size(i).height);
    }
  }
  ~PictureTextures() {
    const GlContext::Current current(context_);
    glDeleteTextures(static_cast<GLsizei>(names_.size()), names_.data());
  }
  PictureTextures(const PictureTextures&) = delete;
  PictureTextures& operator=(const PictureTextures&) = delete;

  std::span<const GLuint> names() const { return names_; }

 private:
  const GlContext& context_;
  std::vector<GLuint> names_;
};

/// Frames as the show takes them where windows share the card: content goes up, nothing comes back.
void timeFramesThatStay(Bench& bench, OpenGlBackend& backend, const GlContext& context,
                        const EngineVenue& engine, Size size, double transportBytes) {
  const PictureTextures textures(context, engine.venue.transport.projectors());
  const NoiseContent content(size);
  FrameReport report;
  const auto windows = static_cast<double>(engine.inverse.bytes());
  for (int steps : {0, 1, 2})
    bench.time(
        fmt::format("{}: frame that stays on the card, K = {}", backend.name(), steps),
        2 * windows + (1 + steps) * transportBytes, [&] {
          if (!backend.renderToTextures(content.frame(), {true, steps, 1.0f, 0.0f}, textures.names(), report))
            throwLost();
        });
}

void timeOpenGl(Bench& bench, const EngineVenue& engine, EngineContent& content, Size size,
                std::unique_ptr<GlContext> context) {
  const GlContext& card = *context;
  OpenGlBackend backend(engine, std::move(context));
  const std::string name(backend.name());
  bench.result.device = name;
  bench.result.copyBytesPerSecond = backend.copyBandwidth();
  backend.setContent(content);
  const NoiseContent noise(size);
  std::vector<std::uint32_t> words(engine.brightest.size());
  FrameReport report;
  backend.render(noise.frame(), {}, words, report);
  const auto transport = static_cast<double>(backend.transportBytes());
  bench.timeReported(name + ": M", static_cast<double>(engine.inverse.bytes()),
                     [&] { return backend.applyWindows(); });
  bench.timeReported(name + ": step", transport, [&] { return backend.takeStep(1.2f); });
  timeFrames(bench, backend, engine, size, transport);
  timeFramesThatStay(bench, backend, card, engine, size, transport);
  timeViewer(bench, backend, engine, content, size, transport);
  timeShadow(bench, backend, engine, content, size, transport);
}

Stack randomStack(std::size_t pixels, std::uint64_t seed) {
  Random random{seed};
  Stack stack(3 * pixels);
  for (float& value : stack) value = random.uniformFloat();
  return stack;
}

void timeReferences(Bench& bench, const EngineVenue& engine) {
  const transport::TransportMatrix& transport = engine.venue.transport;
  const ProjectorStack projector(randomStack(transport.projectors().count(), 1));
  const CameraStack camera(randomStack(transport.cameras().count(), 2));
  bench.time("WindowInverse::apply", static_cast<double>(engine.inverse.bytes()),
             [&] { engine.inverse.apply(camera); });
  bench.time("TransportMatrix: T p and adjoint", 2.0 * static_cast<double>(transport.bytes()),
             [&] { transport.applyTransposed(transport.apply(projector)); });
}

/// M and step against what other programs take for the same.
void compare(EngineBenchResult& result) {
  for (const char* product : {": M", ": step"}) {
    for (const char* reference : {"Eigen CSR", "SciPy CSR"}) {
      const auto other = std::find_if(
          result.lines.begin(), result.lines.end(),
          [&](const EngineBenchLine& line) { return line.name == std::string(reference) + product; });
      if (other == result.lines.end()) continue;
      const double seconds = other->best;
      for (EngineBenchLine& line : result.lines)
        if (line.name.ends_with(product) && line.name.starts_with("CPU"))
          line.timesAsFastAs.push_back({reference, seconds / line.best});
    }
  }
}

compensation::MeasuredVenue venueOf(const EngineBenchSettings& settings) {
  compensation::MeasuredVenue venue;
  const auto several = [](Size size, int count) {
    return Rasters(std::vector<Size>(static_cast<std::size_t>(count), size));
  };
  venue.transport = settings.transport.empty()
                        ? benchTransport(several(settings.projector, settings.projectors),
                                         several(settings.camera, settings.cameras))
                        : transport::loadTransport(settings.transport);
  venue.flood = venue.transport.floodlight();
  venue.black.assign(venue.flood.size(), 0.001f);
  venue.usable.assign(venue.transport.cameras().count(), 1);
  if (venue.transport.cameras().devices() > 1)
    venue.views = compensation::viewMap(venue.transport, venue.usable);
  return venue;
}

/// None: the processor is to do it.
std::unique_ptr<GlContext> contextFor(BackendChoice choice) {
  if (choice == BackendChoice::cpu) return nullptr;
  if (choice == BackendChoice::openGl) return std::make_unique<GlContext>(GlContext::Device::any);
  try {
    return std::make_unique<GlContext>(GlContext::Device::graphics);
  } catch (const Error&) {
    return nullptr;
  }
}

}  // namespace

std::vector<Message> problems(const EngineBenchSettings& settings) {
  constexpr int least = 8;
  std::vector<Message> found;
  for (Size size : {settings.projector, settings.camera, settings.content})
    if (size.width < least || size.height < least)
      found.push_back(RELUCENT_ENGLISH_MESSAGE("engine.size-too-small-to-time", "{} is too small to be timed")
                          .with(as::size(size)));
  constexpr int most = 16;
  for (int devices : {settings.projectors, settings.cameras})
    if (devices < 1 || devices > most)
      found.push_back(RELUCENT_ENGLISH_MESSAGE("engine.devices-to-time-out-of-range",
                                               "1 to {} projectors and cameras are timed")
                          .with(most));
  return found;
}

EngineBenchTiming timedRuns(const std::function<double()>& run) {
  constexpr std::size_t fewest = 5, most = 60;
  constexpr double enough = 0.5;
  run();
  std::vector<double> seconds;
  double sum = 0.0;
  while (seconds.size() < fewest || (sum < enough && seconds.size() < most)) {
    seconds.push_back(run());
    sum += seconds.back();
  }
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds.front()};
}

EngineBenchResult benchEngine(const EngineBenchSettings& settings, Progress& progress) {
  auto wrong = problems(settings);
  require(wrong.empty(), "engine benchmark: {}", fmt::join(wrong, "; "));
  std::unique_ptr<GlContext> context = contextFor(settings.backend);
  const bool oneThread = settings.oneThread && context == nullptr;

  Progress preparing = progress.part(0.5, RELUCENT_MESSAGE("stage.preparing-engine", "Preparing the engine"));
  const compensation::MeasuredVenue venue = venueOf(settings);
  preparing.report(0.3);
  Progress computing =
      preparing.part(0.6, RELUCENT_MESSAGE("stage.windows", "Computing the windows of the inverse"));
  const inverse::WindowInverse inverse =
      inverse::computeWindows(venue.transport, venue.usable, {}, computing);
  EngineSettings plan;
  plan.packing.patchSide = settings.patchSide;
  plan.target.clipping = settings.clipping;
  const std::vector<linearization::ProjectorResponse> responses(venue.transport.projectors().devices());
  const EngineVenue engine = prepareVenue(venue, inverse, responses, plan);
  EngineContent content = prepareContent(engine, settings.content);

  Progress timing = progress.part(0.5, RELUCENT_MESSAGE("stage.timing-engine", "Timing the engine"));
  Bench bench(oneThread ? threadClock : wallClock, timing);
  bench.result.threads = oneThread ? 1 : static_cast<int>(std::thread::hardware_concurrency());
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                            static_cast<std::size_t>(bench.result.threads));
  const bool onProcessor = context == nullptr;
  if (onProcessor)
    timeCpu(bench, engine, content, settings.content);
  else
    timeOpenGl(bench, engine, content, settings.content, std::move(context));
  if (settings.references && onProcessor) {
    timeReferences(bench, engine);
    benchReferences(engine, oneThread, bench.clock(), bench.result);
    compare(bench.result);
  }
  for (EngineBenchLine& line : bench.result.lines)
    line.shareOfCopy = line.bytes / line.best / bench.result.copyBytesPerSecond;
  progress.report(1.0);
  return std::move(bench.result);
}

}  // namespace relucent::engine
