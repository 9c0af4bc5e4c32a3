// SPDX-License-Identifier: MIT
#pragma once

#include "rig/rig.h"
#include "venue/venue_light.h"

namespace relucent {

/// Projectors and camera in front of a simulated venue. The rig's devices belong together: the camera
/// photographs what these projectors show.
Rig simulatedRig(std::shared_ptr<const VenueLight> light);

}  // namespace relucent
