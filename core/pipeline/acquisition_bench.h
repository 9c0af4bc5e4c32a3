// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "relucent/acquisition/settings.h"
#include "relucent/base/progress.h"
#include "relucent/base/raster.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/transport/expected_quality.h"

namespace relucent::pipeline {

struct AcquisitionBenchSettings {
  std::vector<std::string> venues;  // names; none: all of them
  std::vector<acquisition::AcquisitionMode>
      modes;                       // of those that are compared, only these; none: all of them
  std::vector<double> thresholds;  // likewise
  Size projector{256, 192};
  Size camera{160, 120};
  std::uint64_t seed = 1;   // of the noise, and of the patterns
  bool everyLevel = false;  // instead: dense patterns alone, stopped and kept after each of their levels
};
std::vector<Message> problems(const AcquisitionBenchSettings& settings);

/// One measurement of one venue, and how near T came to the truth.
struct AcquisitionBenchRun {
  std::string venue;
  acquisition::AcquisitionMode mode = acquisition::AcquisitionMode::adaptive;
  double threshold = 0.0;  // as a share of the flood image
  acquisition::LitColours colours = acquisition::LitColours::rgb;
  int patterns = 0;  // linearization, references and verification included
  int exposures = 0;
  int linearization = 0;  // exposures of it
  double seconds = 0.0;   // of acquisition; simulated photographs take no exposure time but some computing
  double unresolvedEnergy = 0.0;
  TransportScore transport;
  double windows = 0.0, refined = 0.0;  // PSNR of the reachable pixels with these methods, mean of images, dB
};

/// A measurement that was stopped and kept, or the whole: what was expected of it and what came out.
struct AcquisitionBenchStop {
  std::string venue;
  double threshold = 0.0;
  int blocks = 0;    // side of the finest, projector pixels; 0: the whole
  int patterns = 0;  // of the acquisition, test patterns included
  transport::ExpectedQuality expected;
  double refined = 0.0;  // dB, as ExpectedQuality
};

struct AcquisitionBenchResult {
  Size projector;
  Size camera;
  std::vector<AcquisitionBenchRun> runs;
  std::vector<AcquisitionBenchStop> stops{};  // of every level whose blocks can hold a picture
};

/// Measures simulated venues in every mode at several thresholds, holds T against the truth, and compensates
/// the product's test pictures with it: what each mode costs and what is seen of it. Takes minutes a venue at
/// rehearsal size.
/// Throws: as calibrate() and evaluate().
AcquisitionBenchResult benchAcquisition(const AcquisitionBenchSettings& settings,
                                        const std::filesystem::path& cache, Progress& progress);

}  // namespace relucent::pipeline
