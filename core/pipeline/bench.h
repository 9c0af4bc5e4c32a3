// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/engine/bench/engine_bench.h"
#include "relucent/engine/fallback_backend.h"

namespace relucent::pipeline {

struct Benchmark {
  std::string name;
  double seconds = 0.0;      // one run
  double bytes = 0.0;        // memory traffic of one run that cannot be avoided
  double shareOfCopy = 0.0;  // bytes / seconds / the machine's copy bandwidth
  double best = 0.0;         // of the engine: the shortest run, by which its shares are counted
  std::vector<engine::EngineBenchRatio>
      timesAsFastAs{};  // of the engine: other programs with the same operator
};

struct BenchResult {
  struct Machine {
    std::string processor;
    int threads = 0;
    double copyBytesPerSecond = 0.0;
    std::string device;  // what the engine ran on; empty: not the engine was timed
  } machine;
  std::vector<Benchmark> benchmarks;
  std::vector<Message> notes{};  // what could not be timed, and why
};

/// Times the parts that decide how fast everything else is. `name`: only those that contain it; empty: all.
/// Throws: Error{input} if no benchmark has such a name, naming what there is.
BenchResult bench(const std::string& name, Progress& progress);

/// Times the real-time engine, see benchEngine(const EngineBenchSettings&, Progress&): at 1024x768 / 640x480
/// beside other programs' products, and without them at 1920x1080 / 1632x1224 where the memory is enough. The
/// copy bandwidth is that of the device. Throws: Error{device} if OpenGL was asked for and there is none.
BenchResult benchEngine(engine::BackendChoice backend, Progress& progress);
/// The same with projectors and cameras of those numbers and sizes alone, without other programs' products.
/// Throws: Error{usage} if these are none; as the other.
BenchResult benchEngine(engine::EngineBenchSettings settings, Progress& progress);

}  // namespace relucent::pipeline
