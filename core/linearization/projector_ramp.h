// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/linearization/additivity.h"
#include "relucent/linearization/linearization.h"

namespace relucent::linearization {

/// Measures the light of each channel of a projector at each drive level. Shots in random order over levels
/// and channels, white and black before, after and every 8 shots: lamp power and black level of a shot are
/// interpolated between its neighbours.
///   y = (a . S - a . K(shot)) / lamp(shot),   a: the channel's weights, see LightWeights
/// Throws: Error{numerics} if a channel does not get brighter along its ramp.
ProjectorResponse measureRamps(const LightMeter& meter, std::size_t projector, const Additivity& additivity,
                               const LinearizationSettings& settings, Progress& progress);

/// Drive levels in ascending order, without 0, exact codes of the projector.
std::vector<double> rampLevels(const LinearizationSettings& settings, int bits);

}  // namespace relucent::linearization
