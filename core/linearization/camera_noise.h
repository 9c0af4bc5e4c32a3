// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "relucent/hdr/hdr.h"

namespace relucent::linearization {

/// Two shots of the same light.
using ShotPair = std::pair<rig::Shot, rig::Shot>;

/// Fits readNoise and gain to pairs of equal shots: half the mean square of differences, in bins of equal
/// mean signal, against that mean; a line is fitted by iteratively reweighted least squares, robust to
/// outlying bins. Differences of lamp power between the two shots are divided out first. Bins within 5
/// standard deviations of zero are left out: clipping at zero reduces their noise; the darkest frames only
/// bound the read noise from below.
/// `model` provides response and saturation; without sufficient data its readNoise and gain are kept.
/// Floors: rounding for readNoise, 1e-7 for gain.
hdr::CameraModel withMeasuredNoise(hdr::CameraModel model, const std::vector<ShotPair>& pairs,
                                   std::size_t camera);

/// Relative standard deviation of the light between equal shots; each image's noise averages out.
double flickerOf(const hdr::CameraModel& model, const std::vector<ShotPair>& pairs, std::size_t camera);

/// Fills model.times from the shots' brackets: medians over shots, relative to the last exposure.
hdr::CameraModel withMeasuredTimes(hdr::CameraModel model, const std::vector<ShotPair>& pairs,
                                   std::size_t camera);

}  // namespace relucent::linearization
