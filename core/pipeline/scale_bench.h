// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/base/raster.h"

namespace relucent::pipeline {

/// Sizes of a venue's devices.
struct VenueSizes {
  Size projector;
  Size camera;
  bool operator==(const VenueSizes&) const = default;
};

struct ScaleBenchSettings {
  std::string venue = "corner";
  std::vector<VenueSizes> sizes{
      {{1024, 768}, {640, 480}}, {{1920, 1080}, {1600, 1200}}, {{3840, 2160}, {1600, 1200}}};
  int pathsPerPixel = 64;  // of the light tracer: a large camera's pixels share what is seen beside them
  std::uint64_t seed = 1;
  /// Stages after those of a calibration and its first still.
  struct Stage {
    std::string name;
    std::function<void(const std::filesystem::path& calibration, const std::filesystem::path& out,
                       Progress& progress)>
        run;
  };
  std::vector<Stage> after{};
};
std::vector<Message> problems(const ScaleBenchSettings& settings);

/// What one stage took.
struct ScaleStage {
  std::string name;
  double seconds = 0.0;           // by the wall clock
  std::uint64_t memoryBytes = 0;  // the most, without mapped files ...
  std::uint64_t filesBytes = 0;   // ... and what of these was in memory, that had room for it
  double processorSeconds = 0.0;  // of all cores together: what to compare on a machine that others use too
};

struct ScaleBenchRun {
  VenueSizes sizes;
  Size used;  // what is made of the camera's pixels
  int exposures = 0;
  std::uint64_t leaves = 0;
  std::uint64_t forecastBytes = 0;  // of memory, mapped files included, before the first photograph of T
  std::uint64_t photographBytes = 0, resultBytes = 0;  // on the disk
  double secondsToStill = 0.0;  // from the last photograph of T to the first compensated still
  std::vector<ScaleStage> stages;
  double windows = 0.0, refined = 0.0;  // PSNR of the reachable pixels, mean of images, dB
};

struct ScaleBenchResult {
  std::string venue;
  std::vector<ScaleBenchRun> runs;
};

/// p of seconds ~ pixels^p between two runs, all devices' pixels together; by stage of the second run, NaN
/// for what the first has not.
std::vector<double> growthOf(const ScaleBenchRun& before, const ScaleBenchRun& after);

/// Measures a simulated venue at each size, as calibrate() does it, and compensates a still: what each stage
/// takes. The venue is part of the program and of its memory. Minutes to hours.
/// Throws: as calibrate(), compensate() and evaluate().
ScaleBenchResult benchScale(const ScaleBenchSettings& settings, const std::filesystem::path& cache,
                            Progress& progress);

}  // namespace relucent::pipeline
