// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/rig/rig.h"
#include "relucent/venue/device_faults.h"
#include "relucent/venue/venue_light.h"

namespace relucent::venue {

/// Projectors and camera in front of a simulated venue. The rig's devices belong together: the camera
/// photographs what these projectors show.
rig::Rig simulatedRig(std::shared_ptr<const VenueLight> light);
/// The same with faults, see device_faults.h.
rig::Rig simulatedRig(std::shared_ptr<const VenueLight> light, FaultsDuring faults);

}  // namespace relucent::venue
