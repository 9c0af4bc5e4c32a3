// SPDX-License-Identifier: MIT
#pragma once

#include "acquisition/growth.h"
#include "acquisition/verification.h"
#include "transport/acquisition.h"

namespace relucent {

/// Verification of `result.transport`: error, flags and residual maps.
void verifyOnly(Acquisition& result, Watch& watch, const References& references,
                const AcquisitionSettings& settings, Progress& progress);

/// The same; then flagged camera pixels are measured again, at most twice. Only the blocks that they need are
/// lit: as they are few, so are the conflicts, and many blocks share a frame. A row measured again replaces
/// the old one if it predicts other test patterns better than that did its own; what stays flagged is left as
/// a mask. A second time only if the first healed half of them.
/// Throws: as Watch::check().
void verifyAndRepair(Acquisition& result, Watch& watch, const References& references, const Scheme& scheme,
                     const AcquisitionSettings& settings, Progress& progress);

}  // namespace relucent
