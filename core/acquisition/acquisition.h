// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "acquisition/settings.h"
#include "hdr/hdr.h"
#include "linearization/linearization.h"
#include "sentinels/alarm.h"
#include "transport/transport_matrix.h"

namespace relucent {

/// Everything that acquisition measured.
struct Acquisition {
  TransportMatrix transport;          // signed leaves; the projector's black level is in `black`
  Stack black, blackVariance;         // e: the image under a black projector
  Stack flood, floodVariance;         // the images under full red, green and blue, less e, summed
  std::vector<std::uint8_t> flagged;  // per camera pixel: the verification found it wrong
  std::vector<Stack> residual;  // verification, blocks of 1, 2, 4, 8 pixels: root mean square error, radiance
  Stack leafVariance;           // of each row's leaves, per camera channel, mean
  int remeasured = 0;           // camera pixels that were flagged and measured again
  double unresolvedEnergy = 0.0;   // share of the flood image's energy that no leaf explains
  double verificationError = 0.0;  // relative error of held-out patterns over all pixels
  int patterns = 0;
  int exposures = 0;
  std::vector<std::string> findings;  // sentences
};

/// Measures the light transport by the scheme of the settings.  Source: core/acquisition/README.md; the tree
/// is Sen et al. 2005's, thresholds, scheduling and unmixing of the adaptive scheme are ours. While it
/// measures, sentinels watch the light and the view; `handler` is asked what to do about an alarm. After an
/// alarm that was retried, the result is the same bits as if it had not happened. Stop and keep: ends after
/// the level under way with a valid, coarser T. Throws: Error{device, input, disk}; Cancelled.
Acquisition acquire(ShotTaker& shots, const Linearization& linearization, const AcquisitionSettings& settings,
                    const AlarmHandler& handler, Progress& progress);
/// The same with nobody to ask: an alarm is Error{device}; running it again goes on from what is safe.
Acquisition acquire(ShotTaker& shots, const Linearization& linearization, const AcquisitionSettings& settings,
                    Progress& progress);

}  // namespace relucent
