// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "relucent/rig/rig.h"

namespace relucent::devices {

/// The exposure of whole projector frames that is nearest to `seconds`, at least one: a projector's light is
/// even only over whole frames (lamp modulation, colour wheel, dithering). Of those within `range`.
///   n frame,  n = max(1, round(seconds / frame))
/// Throws: std::logic_error unless `frame` > 0 and one of them lies within the range.
double wholeFrames(double seconds, double frame, const rig::ExposureRange& range);

bool hasWholeFrames(const rig::ExposureRange& range, double frame);
/// The shortest and the longest exposure of whole frames within a range; `range` itself if there is none.
rig::ExposureRange wholeFramesIn(const rig::ExposureRange& range, double frame);

/// The same camera; what it exposes is whole frames of the projector. As it is if no whole frame lies within
/// the camera's range.
std::unique_ptr<rig::Camera> inWholeFrames(std::unique_ptr<rig::Camera> camera, double frame);

}  // namespace relucent::devices
