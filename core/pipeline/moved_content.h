// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/compensation/target.h"
#include "relucent/pipeline/content_settings.h"
#include "relucent/sentinels/movement.h"

namespace relucent::pipeline {

/// Where what lies at `corners` of a view of that size is seen once the view has moved:
///   x' = R (x - c) + c + m,   c the view's centre, R the turn by m's degrees
compensation::Corners movedCorners(const compensation::Corners& corners, const sentinels::Movement& moved,
                                   Size view);

/// Content that stands on the surface where it stood, once the cameras' views have moved: corners and masks
/// go with their view, held within it. What was placed automatically stays where `before` placed it, by
/// corners of its own unless `now` places it there, too: automatic places jump where little has changed.
///   aspect  of what is shown, width over height
///   moved   of each camera
ContentSettings movedContent(ContentSettings content, double aspect,
                             const compensation::MeasuredVenue& before,
                             const compensation::MeasuredVenue& now,
                             const std::vector<sentinels::Movement>& moved);

}  // namespace relucent::pipeline
