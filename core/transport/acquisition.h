// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/transport/expected_quality.h"
#include "relucent/transport/found_change.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::transport {

/// The light transport of a venue, measured there or estimated from pictures of it, with what is known of its
/// errors. Finished where it is made; nothing of it changes afterwards.
struct Acquisition {
  TransportMatrix transport;         // signed leaves; the projector's black level is in `black`
  CameraStack black, blackVariance;  // e: the image under a black projector
  CameraStack flood, floodVariance;  // the images under full red, green and blue, less e, summed
  CameraMask flagged;                // per camera pixel: the verification found it wrong
  std::vector<CameraStack>
      residual;              // verification, blocks of 1, 2, 4, 8 pixels: root mean square error, radiance
  CameraStack leafVariance;  // of each row's leaves, per camera channel, mean
  int remeasured = 0;        // camera pixels that were flagged and measured again
  double unresolvedEnergy = 0.0;   // share of the flood image's energy that no leaf explains
  double verificationError = 0.0;  // relative error of held-out patterns over all pixels
  int patterns = 0;
  int exposures = 0;
  int stoppedAt =
      0;  // side of the finest blocks, projector pixels, if it was stopped and kept; 0: as fine as asked for
  std::optional<ExpectedQuality> expected{};  // of dense patterns
  std::vector<Message> findings;              // sentences
  std::optional<FoundChange> changed{};       // with which it ended; none: nothing had changed
  double overexposed = 0.0;  // share of the camera pixels that were too bright for every exposure
};

/// The share of the camera pixels that the verification found wrong.
inline double leftOut(const Acquisition& acquisition) {
  if (acquisition.flagged.empty()) return 0.0;
  const auto flagged = std::count(acquisition.flagged.begin(), acquisition.flagged.end(), 1);
  return static_cast<double>(flagged) / static_cast<double>(acquisition.flagged.size());
}

}  // namespace relucent::transport
