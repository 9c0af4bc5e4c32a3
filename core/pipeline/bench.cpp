// SPDX-License-Identifier: MIT
#include "relucent/pipeline/bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <thread>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/base/random.h"
#include "relucent/compensation/ridge_choice.h"
#include "relucent/engine/bench/bench_transport.h"
#include "relucent/engine/bench/engine_bench.h"
#include "relucent/platform/process.h"

namespace relucent::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

/// Median seconds of a run; at least three runs and at least `least` seconds in all, after one to warm up.
double secondsOf(const std::function<void()>& run, double least = 0.5) {
  run();
  std::vector<double> seconds;
  double sum = 0.0;
  while (seconds.size() < 3 || sum < least) {
    auto begin = Clock::now();
    run();
    seconds.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    sum += seconds.back();
  }
  std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2),
                   seconds.end());
  return seconds[seconds.size() / 2];
}

/// Bytes read and written per second by a plain copy on all cores, well beyond every cache.
double copyBandwidth() {
  constexpr std::size_t bytes = std::size_t{1} << 28;
  constexpr std::size_t chunks = 64;
  std::vector<char> from(bytes, 1);
  std::vector<char> to(bytes, 0);
  double seconds = secondsOf([&] {
    parallelChunks(0, bytes, chunks, [&](std::size_t, std::size_t begin, std::size_t end) {
      std::memcpy(to.data() + begin, from.data() + begin, end - begin);
    });
  });
  return 2.0 * static_cast<double>(bytes) / seconds;
}

std::string processorName() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown";
}

Stack randomStack(std::size_t values, std::uint64_t seed) {
  Random random{seed};
  Stack stack(values);
  for (float& value : stack) value = random.uniformFloat();
  return stack;
}

/// One thing to time. Bytes: what must cross the memory bus at least.
struct Case {
  std::string name;
  double bytes;
  std::function<void()> run;
};

/// Bytes that programs may still take.
double availableMemory() {
  std::ifstream info("/proc/meminfo");
  for (std::string line; std::getline(info, line);)
    if (double kibibytes = 0.0; std::sscanf(line.c_str(), "MemAvailable: %lf", &kibibytes) == 1)
      return 1024.0 * kibibytes;
  return 0.0;
}

void append(const engine::EngineBenchResult& engine, const std::string& prefix, BenchResult& result) {
  for (const engine::EngineBenchLine& line : engine.lines)
    result.benchmarks.push_back(
        {prefix + line.name, line.seconds, line.bytes, line.shareOfCopy, line.best, line.timesAsFastAs});
  result.notes.insert(result.notes.end(), engine.notes.begin(), engine.notes.end());
}

std::string sizesOf(const engine::EngineBenchSettings& settings) {
  return fmt::format("{}x{} / {}x{}", settings.projector.width, settings.projector.height,
                     settings.camera.width, settings.camera.height);
}

}  // namespace

BenchResult benchEngine(engine::EngineBenchSettings settings, Progress& progress) {
  if (const std::vector<Message> wrong = problems(settings); !wrong.empty())
    throw Error(ErrorKind::usage, wrong.front(),
                RELUCENT_ENGLISH_MESSAGE("bench.choose-other-sizes", "choose other sizes"));
  settings.references = false;
  const engine::EngineBenchResult engine = engine::benchEngine(settings, progress);
  BenchResult result;
  result.machine = {processorName(), engine.threads, engine.copyBytesPerSecond, engine.device};
  append(engine, "", result);
  result.notes.push_back(RELUCENT_ENGLISH_MESSAGE("bench.peak-memory", "{} MB of memory at the most")
                             .with(as::megabytes(platform::peakMemoryBytes())));
  return result;
}

BenchResult benchEngine(engine::BackendChoice backend, Progress& progress) {
  engine::EngineBenchSettings settings;
  settings.backend = backend;
  Progress usual = progress.part(0.4, Message::plain(sizesOf(settings)));
  const engine::EngineBenchResult engine = engine::benchEngine(settings, usual);
  BenchResult result;
  result.machine = {processorName(), engine.threads, engine.copyBytesPerSecond, engine.device};
  append(engine, "", result);

  constexpr double memoryOfLarge = 12e9;
  settings.projector = {1920, 1080};
  settings.camera = {1632, 1224};
  settings.references = false;
  const std::string sizes = sizesOf(settings);
  if (availableMemory() < memoryOfLarge) {
    result.notes.push_back(
        RELUCENT_ENGLISH_MESSAGE("bench.skipped-for-memory", "{} was not timed: it takes {} GB of memory")
            .with(sizes, as::number(memoryOfLarge / 1e9, as::decimals(0))));
    return result;
  }
  Progress large = progress.part(0.6, Message::plain(sizes));
  append(engine::benchEngine(settings, large), sizes + ", ", result);
  return result;
}

BenchResult bench(const std::string& name, Progress& progress) {
  BenchResult result;
  result.machine.processor = processorName();
  result.machine.threads = static_cast<int>(std::thread::hardware_concurrency());
  Progress preparing =
      progress.part(0.3, RELUCENT_MESSAGE("stage.preparing-benchmarks", "Preparing the benchmarks"));
  result.machine.copyBytesPerSecond = copyBandwidth();
  preparing.report(0.3);

  const transport::TransportMatrix transport = engine::benchTransport({1024, 768}, {640, 480});
  preparing.report(0.8);
  auto cameraValues = transport.cameras().count() * 3;
  auto projectorValues = transport.projectors().count() * 3;
  auto nodeValues = transport.layout().count() * 3;
  CameraStack camera(randomStack(cameraValues, 1));
  ProjectorStack projector(randomStack(projectorValues, 2));
  inverse::WindowInverse windows;
  auto prepareWindows = [&] {
    CameraMask usable(transport.cameras().count(), 1);
    Progress silent;
    windows = inverse::computeWindows(transport, usable, inverse::WindowSettings{}, silent);
  };

  auto floats = [](std::size_t count) { return static_cast<double>(count) * sizeof(float); };
  double leaves = static_cast<double>(transport.bytes());
  std::vector<Case> cases{
      {"transport/apply", leaves + floats(cameraValues) + floats(projectorValues) + 2 * floats(nodeValues),
       [&] { transport.apply(projector); }},
      {"transport/adjoint", leaves + floats(cameraValues) + floats(projectorValues) + 2 * floats(nodeValues),
       [&] { transport.applyTransposed(camera); }},
      {"transport/means", floats(projectorValues) + floats(nodeValues),
       [&] { transport.layout().means(projector); }},
      {"windows/compute", leaves, prepareWindows},
      {"windows/choose-ridge", leaves,
       [&] {
         Progress silent;
         compensation::MeasuredVenue venue{transport, CameraStack(cameraValues, 0.0f), transport.floodlight(),
                                           CameraMask(transport.cameras().count(), 1)};
         windows = chooseRidge(venue, inverse::WindowSettings{}, silent).inverse;
       }},
      {"windows/apply", 0.0, [&] { windows.apply(camera); }},
  };
  std::vector<Case*> wanted;
  for (Case& candidate : cases)
    if (candidate.name.find(name) != std::string::npos) wanted.push_back(&candidate);
  if (wanted.empty()) {
    std::string known;
    for (const Case& candidate : cases) known += (known.empty() ? "" : ", ") + candidate.name;
    throw Error(ErrorKind::usage,
                RELUCENT_ENGLISH_MESSAGE("bench.unknown", "there is no benchmark named \"{}\"").with(name),
                RELUCENT_ENGLISH_MESSAGE("bench.choose-one", "choose one of: {}").with(known));
  }

  for (Case* benchmark : wanted) {
    Progress running =
        progress.part(0.7 / static_cast<double>(wanted.size()), Message::plain(std::string(benchmark->name)));
    if (benchmark->name == "windows/apply") {
      if (windows.bytes() == 0) prepareWindows();
      benchmark->bytes =
          static_cast<double>(windows.bytes()) + floats(cameraValues) + floats(projectorValues);
    }
    double seconds = secondsOf(benchmark->run);
    result.benchmarks.push_back({benchmark->name, seconds, benchmark->bytes,
                                 benchmark->bytes / seconds / result.machine.copyBytesPerSecond});
  }
  progress.report(1.0);
  return result;
}

}  // namespace relucent::pipeline
