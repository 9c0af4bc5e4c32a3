// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/linearization/additivity.h"
#include "relucent/linearization/photographed_light.h"

namespace relucent::linearization {

/// What sums of photographed light say of the additivity of each projector's light, the drift of its lamp
/// divided out: white where the projector shines; its first group where that is the brightest of all first
/// groups. Per projector. `fits` of the same photographs.
/// Source: core/linearization/README.md, 4.
std::vector<Additivity> additivitiesOf(const MosaicPhotographs& photographs, const PhotographedLight& lights,
                                       const std::vector<ResponseFit>& fits);

}  // namespace relucent::linearization
