// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/venue/scene.h"
#include "relucent/venue/venue.h"

namespace relucent::venue {

/// The scene of an available venue (see venues()), with devices of the settings' sizes.
/// Changes since it was measured are not made. Contract: the name is one of venues().
Scene buildScene(const VenueSettings& settings);

/// A projector and a camera in a typical position in front of a wall at z = 0: projector at 2.4 m, a little
/// to the right, camera at the same distance to the left with a slightly wider view. The projector is focused
/// at its distance to `target`; `defocus`: diameter of the blur, in projector pixels, of a point infinitely
/// far behind that.
void placeDevices(Scene& scene, const VenueSettings& settings, const Eigen::Vector3f& target, float defocus);

Scene statueScene(const VenueSettings& settings);
Scene glassScene(const VenueSettings& settings);
Scene reliefScene(const VenueSettings& settings);

}  // namespace relucent::venue
