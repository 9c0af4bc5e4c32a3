// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hdr/hdr.h"
#include "linearization/linearization.h"
#include "transport/transport_matrix.h"

namespace relucent {

struct AcquisitionSettings {
  double relativeThreshold = 0.008;  // tau_i = max(this * F_i, noise floor); 0.006 fine, 0.02 fast
  double dimShare = 0.2;     // pixels dimmer than this share of the typical F are resolved as if they had it
  double noiseSigmas = 4.0;  // the noise floor of tau, in standard deviations of a frame
  int references = 4;        // black and flood shots averaged
  int verificationPatterns = 8;  // held-out random patterns, block sizes 1, 2, 4, 8
  double flagRelative = 0.1;     // a pixel is flagged when its residual exceeds this share of its light
  double flagSigmas = 3.0;       // and this many standard deviations
  std::uint64_t seed = 1;        // of the verification patterns
};
std::vector<std::string> problems(const AcquisitionSettings& settings);

/// Everything that acquisition measured.
struct Acquisition {
  TransportMatrix transport;          // signed leaves; the projector's black level is in `black`
  Stack black, blackVariance;         // e: the image under a black projector
  Stack flood, floodVariance;         // the images under full red, green and blue, less e, summed
  std::vector<std::uint8_t> flagged;  // per camera pixel: the verification found it wrong
  double unresolvedEnergy = 0.0;      // share of the flood image's energy that no leaf explains
  double verificationError = 0.0;     // relative error of held-out patterns over all pixels
  int patterns = 0;
  int exposures = 0;
  std::vector<std::string> findings;  // sentences
};

/// Adaptive hierarchical acquisition, red, green and blue in turn.  Source: core/acquisition/README.md;
/// the tree is Sen et al. 2005's, thresholds, scheduling and unmixing are ours.
/// Stop and keep: ends after the level under way with a valid, coarser T.
/// Throws: Error{device, input, disk}; Cancelled.
Acquisition acquire(ShotTaker& shots, const Linearization& linearization, const AcquisitionSettings& settings,
                    Progress& progress);

}  // namespace relucent
