// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/engine/engine_plan.h"
#include "relucent/engine/fallback_backend.h"

namespace relucent::engine {

struct EngineBenchSettings {
  Size projector{1024, 768};
  Size camera{640, 480};
  int projectors = 1, cameras = 1;  // of these sizes
  Size content{1920, 1080};
  std::filesystem::path transport;  // a calibration's T instead of benchTransport()
  BackendChoice backend = BackendChoice::automatic;
  int patchSide = PackingSettings().patchSide;
  bool references = true;  // also time the products of the pipeline, Eigen and SciPy
  bool oneThread = false;  // of the processor: CPU seconds of one core, for shared machines
  compensation::Clipping clipping = compensation::Clipping::channels;
};
std::vector<Message> problems(const EngineBenchSettings& settings);

/// Speed relative to another program's product with the same operator.
struct EngineBenchRatio {
  std::string reference;
  double times = 0.0;
};

struct EngineBenchLine {
  std::string name;
  double seconds = 0.0;  // median
  double best = 0.0;
  double bytes = 0.0;        // of operator data that must be read
  double shareOfCopy = 0.0;  // bytes / best / copy bandwidth of the same device, read and written
  std::vector<EngineBenchRatio> timesAsFastAs;  // best run of both
};

struct EngineBenchResult {
  std::string device;  // device of the back end
  int threads = 0;     // of the processor
  double copyBytesPerSecond = 0.0;
  std::vector<EngineBenchLine> lines;
  std::vector<Message> notes;  // measurements that were not possible, and why
};

/// Times the engine: M, one step, whole frames with K = 0, 1 and 2; of several cameras also a frame for a
/// viewer who walks on: ViewFollower, and one step from the frame before; of several projectors one while a
/// shadow fades, AvailabilityFollower. Takes minutes of preparation at
/// large sizes. Throws: Error{device} if OpenGL was asked for and there is none; as loadTransport();
/// Cancelled.
EngineBenchResult benchEngine(const EngineBenchSettings& settings, Progress& progress);

/// Median and best of the seconds that a function returns, after one warm-up run.
struct EngineBenchTiming {
  double median = 0.0, best = 0.0;
};
EngineBenchTiming timedRuns(const std::function<double()>& run);

}  // namespace relucent::engine
