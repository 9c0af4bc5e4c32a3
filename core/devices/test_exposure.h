// SPDX-License-Identifier: MIT
#pragma once

#include "base/progress.h"
#include "devices/latency.h"
#include "rig/rig.h"

namespace relucent {

/// Exposure time at which white comes out with a mean signal of 0.15 to 0.6, as far as the camera can: found
/// by doubling and halving from one projector frame.  Throws: Cancelled; as the devices.
double testExposure(Projector& projector, Camera& camera, const LatencySettings& settings, const Wait& wait,
                    const Progress& progress);

}  // namespace relucent
