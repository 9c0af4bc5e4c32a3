// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "hdr/hdr.h"

namespace relucent {

/// Two shots of the same light.
using ShotPair = std::pair<Shot, Shot>;

/// Fits readNoise and gain to pairs of equal shots: half the mean square of differences, in bins of equal
/// mean signal, against that mean; a line by iteratively reweighted least squares that outlying bins do not
/// pull. Differences of lamp power between the two shots are divided out first. Bins within 5 standard
/// deviations of zero are left out: cutting at zero makes them look calmer than they are; the darkest frames
/// only bound the read noise from below.
/// `model` brings response and saturation; where the data say nothing its readNoise and gain stay.
/// Floors: rounding for readNoise, 1e-7 for gain.
CameraModel withMeasuredNoise(CameraModel model, const std::vector<ShotPair>& pairs, std::size_t camera);

/// Relative standard deviation of the light between equal shots; each image's noise averages out.
double flickerOf(const CameraModel& model, const std::vector<ShotPair>& pairs, std::size_t camera);

/// Fills model.times from the shots' brackets: medians over shots, relative to the last exposure.
CameraModel withMeasuredTimes(CameraModel model, const std::vector<ShotPair>& pairs, std::size_t camera);

}  // namespace relucent
