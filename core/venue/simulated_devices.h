// SPDX-License-Identifier: MIT
#pragma once

#include "rig/rig.h"
#include "venue/device_faults.h"
#include "venue/venue_light.h"

namespace relucent {

/// Projectors and camera in front of a simulated venue. The rig's devices belong together: the camera
/// photographs what these projectors show.
Rig simulatedRig(std::shared_ptr<const VenueLight> light);
/// The same with faults, see device_faults.h. The schedule may be changed while the rig is in use.
Rig simulatedRig(std::shared_ptr<const VenueLight> light, std::shared_ptr<const FaultSchedule> faults);

}  // namespace relucent
