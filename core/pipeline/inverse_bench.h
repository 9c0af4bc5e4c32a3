// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/clustering/clustering.h"
#include "relucent/compensation/method.h"

namespace relucent::pipeline {

/// What inverting one venue's light transport took, and what it was good for.
struct VenueInversion {
  std::string venue;
  std::size_t leaves = 0;
  double windowSeconds = 0.0;                      // the default operator, with the search for its ridge
  double ridge = 0.0;                              // that it found
  double clusterSeconds = 0.0;                     // Algorithm 1 as printed, connected components and maps
  clustering::ClusteringStatistics printed;        // its clusters
  double cappedSeconds = 0.0;                      // the same, clusters held to a size
  clustering::ClusteringStatistics capped;         //
  double truncatedSeconds = 0.0;                   // inverting the capped clusters: the paper's truncated SVD
  double ridgeSeconds = 0.0;                       // and by ridge
  double fullColourSeconds = 0.0;                  // by ridge, every connection its 3x3 block
  std::map<compensation::Method, double> quality;  // dB, per method, mean over the product's pictures
  double truncatedQuality = 0.0;                   // dB of `clusters` inverted by truncated SVD
  double fullColourQuality = 0.0;                  // dB of `clusters` with full 3x3 blocks (paper, eq. 2)
};

struct InverseBenchResult {
  std::vector<VenueInversion> venues;
};

/// Measures every simulated venue at rehearsal size and inverts it in all ways, beside what Wetzstein &
/// Bimber 2007 report. Takes minutes. Throws: as calibrate() and evaluate().
InverseBenchResult benchInverse(const std::filesystem::path& cache, Progress& progress);

/// What the paper reports of its scenes.
struct PaperFigures {
  double leastInversionSeconds = 13 * 60.0;  // fig. 6, Pentium 4 at 3 GHz
  double mostInversionSeconds = 15 * 60.0;   // fig. 5
  double leastError = 0.7;                   // relative RMS error of rows after clustering, fig. 4
  double mostError = 0.8;
  double leastFrameRate = 7.0;  // GeForce 7900 GTX
  double mostFrameRate = 30.0;
};

}  // namespace relucent::pipeline
