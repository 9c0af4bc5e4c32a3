// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "engine/engine_plan.h"
#include "engine/fallback_backend.h"

namespace relucent {

struct EngineBenchSettings {
  Size projector{1024, 768};
  Size camera{640, 480};
  Size content{1920, 1080};
  std::filesystem::path transport;  // a calibration's T instead of benchTransport()
  BackendChoice backend = BackendChoice::automatic;
  int patchSide = EngineSettings().patchSide;
  bool references = true;  // beside them the pipeline's own products, Eigen's and SciPy's
  bool oneThread = false;  // of the processor: seconds of one core, for machines that others use too
};
std::vector<std::string> problems(const EngineBenchSettings& settings);

/// How many times as fast as another program's product with the same operator.
struct EngineBenchRatio {
  std::string reference;
  double times = 0.0;
};

struct EngineBenchLine {
  std::string name;
  double seconds = 0.0;  // median
  double best = 0.0;
  double bytes = 0.0;        // of operator that must be read
  double shareOfCopy = 0.0;  // bytes / best / what the same device copies in a second, read and written
  std::vector<EngineBenchRatio> timesAsFastAs;  // by the best of both
};

struct EngineBenchResult {
  std::string device;  // what the back end runs on
  int threads = 0;     // of the processor
  double copyBytesPerSecond = 0.0;
  std::vector<EngineBenchLine> lines;
  std::vector<std::string> notes;  // what could not be timed, and why
};

/// Times the engine: M, one step, whole frames with K = 0, 1 and 2. Takes minutes of preparation at large
/// sizes. Throws: Error{device} if OpenGL was asked for and there is none; as loadTransport(); Cancelled.
EngineBenchResult benchEngine(const EngineBenchSettings& settings, Progress& progress);

/// Median and best seconds of something that says itself how long it took, after one run to warm up.
struct EngineBenchTiming {
  double median = 0.0, best = 0.0;
};
EngineBenchTiming timedRuns(const std::function<double()>& run);

}  // namespace relucent
