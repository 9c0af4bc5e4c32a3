// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "acquisition/settings.h"
#include "hdr/hdr.h"
#include "linearization/linearization.h"
#include "transport/transport_matrix.h"

namespace relucent {

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
