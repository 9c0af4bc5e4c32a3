// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "relucent/acquisition/settings.h"
#include "relucent/acquisition/tree_context.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::acquisition {

/// T while it is being verified, and what the verification found so far.
struct VerifiedTransport {
  transport::TransportMatrix transport;
  CameraStack leafVariance;           // see Acquisition
  CameraMask flagged;                 // per camera pixel: wrong
  std::vector<CameraStack> residual;  // per block size of the test patterns, radiance
  double error = 0.0;                 // relative, of held-out patterns over all pixels
  int remeasured = 0;                 // camera pixels that were flagged and measured again
};

/// Verification of T: error, flags and residual maps. After an interruption they are as they were. Throws: as
/// Watch::check().
[[nodiscard]] std::optional<sentinels::Interruption> verifyOnly(VerifiedTransport& verified,
                                                                const TreeContext& context,
                                                                const AcquisitionSettings& settings,
                                                                Progress& progress);

/// The same; then flagged camera pixels, if the scheme says that they are many enough, are measured again, at
/// most twice; not if they are more than a fifth of those in use. Only the blocks that they need are
/// lit: as they are few, so are the conflicts, and many blocks share a frame. A row measured again replaces
/// the old one if it predicts other test patterns better than that did its own; what stays flagged is left as
/// a mask. A second time only if the first healed half of them. After an interruption T is as the last repair
/// that was finished left it. Throws: as Watch::check().
[[nodiscard]] std::optional<sentinels::Interruption> verifyAndRepair(VerifiedTransport& verified,
                                                                     const TreeContext& context,
                                                                     const AcquisitionSettings& settings,
                                                                     Progress& progress);

}  // namespace relucent::acquisition
