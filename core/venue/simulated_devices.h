// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/rig/rig.h"
#include "relucent/venue/device_faults.h"
#include "relucent/venue/venue_light.h"

namespace relucent::venue {

/// Projectors and cameras in front of a simulated venue. The rig's devices belong together: the cameras
/// photograph what these projectors show.
rig::Rig simulatedRig(std::shared_ptr<const VenueLight> light);
/// The same with faults, see device_faults.h: those of a camera and of what it sees are the first one's.
rig::Rig simulatedRig(std::shared_ptr<const VenueLight> light, FaultsDuring faults);

}  // namespace relucent::venue
