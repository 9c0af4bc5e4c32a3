// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "relucent/acquisition/settings.h"
#include "relucent/base/progress.h"
#include "relucent/base/raster.h"
#include "relucent/pipeline/evaluate.h"

namespace relucent::pipeline {

struct AcquisitionBenchSettings {
  std::vector<std::string> venues;  // names; none: all of them
  std::vector<acquisition::AcquisitionMode>
      modes;                       // of those that are compared, only these; none: all of them
  std::vector<double> thresholds;  // likewise
  Size projector{256, 192};
  Size camera{160, 120};
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

struct AcquisitionBenchResult {
  Size projector;
  Size camera;
  std::vector<AcquisitionBenchRun> runs;
};

/// Measures simulated venues in every mode at several thresholds, holds T against the truth, and compensates
/// the product's test pictures with it: what each mode costs and what is seen of it. Takes minutes a venue at
/// rehearsal size.
/// Throws: as calibrate() and evaluate().
AcquisitionBenchResult benchAcquisition(const AcquisitionBenchSettings& settings,
                                        const std::filesystem::path& cache, Progress& progress);

}  // namespace relucent::pipeline
