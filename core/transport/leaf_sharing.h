// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/progress.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::transport {

/// What a shared leaf may be off by, as a share of the camera pixel's light.
inline constexpr float sharingTolerance = 0.005f;

/// T with leaves that neighbouring camera pixels share, in a third of them: for each projector and each 8x8
/// camera pixels, near leaves that are alike become one (row_light.h), and far ones belong to as wide a block
/// of camera pixels as the tolerance permits (shared_light.h). The sums of rows are T's, so that the flood
/// image is preserved. The same T where colours are not shared already, or where there are groups already.
/// Same bits for every number of threads.  Throws: Cancelled.  Source: core/transport/README.md.
TransportMatrix withSharedLeaves(const TransportMatrix& transport, float tolerance, Progress& progress);

}  // namespace relucent::transport
