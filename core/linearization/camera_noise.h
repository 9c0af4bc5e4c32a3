// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "hdr/hdr.h"

namespace relucent {

/// Two shots of the same light.
using ShotPair = std::pair<Shot, Shot>;

/// Fits readNoise and gain to pairs of equal shots: half the mean square of differences, in bins of equal
/// mean signal, against that mean; a line is fitted by iteratively reweighted least squares, robust to
/// outlying bins. Differences of lamp power between the two shots are divided out first. Bins within 5
/// standard deviations of zero are left out: clipping at zero reduces their noise; the darkest frames only
/// bound the read noise from below.
/// `model` provides response and saturation; without sufficient data its readNoise and gain are kept.
/// Floors: rounding for readNoise, 1e-7 for gain.
CameraModel withMeasuredNoise(CameraModel model, const std::vector<ShotPair>& pairs, std::size_t camera);

/// Relative standard deviation of the light between equal shots; each image's noise averages out.
double flickerOf(const CameraModel& model, const std::vector<ShotPair>& pairs, std::size_t camera);

/// Fills model.times from the shots' brackets: medians over shots, relative to the last exposure.
CameraModel withMeasuredTimes(CameraModel model, const std::vector<ShotPair>& pairs, std::size_t camera);

}  // namespace relucent
