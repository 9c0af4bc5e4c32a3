// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/progress.h"
#include "relucent/devices/check/latency.h"
#include "relucent/rig/rig.h"

namespace relucent::devices {

/// Exposure time at which white comes out with a mean signal of 0.15 to 0.6, as far as the camera can: found
/// by doubling and halving from one projector frame.  Throws: Cancelled; as the devices.
double testExposure(rig::Projector& projector, rig::Camera& camera, const LatencySettings& settings,
                    const Wait& wait, const Progress& progress);

}  // namespace relucent::devices
