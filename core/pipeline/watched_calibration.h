// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/monitoring/watched_venue.h"
#include "relucent/pipeline/measured_venue.h"

namespace relucent::pipeline {

/// What one camera of a calibration has to know to watch a show (core/monitoring). Keeps nothing of `measured`.
/// Contract: it has such a camera.
monitoring::WatchedVenue watchedVenueOf(const MeasuredCalibration& measured, std::size_t camera,
                                        const monitoring::SamplingSettings& sampling = {});

/// The linear light of every drive code of 8 bits, per projector and channel: what pictures that were sent are
/// read with.
using CodeLights = std::vector<std::array<std::array<float, 256>, 3>>;
CodeLights lightOfCodes(const linearization::Linearization& linearization);

}  // namespace relucent::pipeline
