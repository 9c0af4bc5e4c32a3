// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/rig/shot.h"

namespace relucent::linearization {

/// Exposures that suit a venue.
struct ExposureChoice {
  std::vector<double> seconds;     // longest first
  std::vector<double> saturation;  // per camera: signals from this value on are saturated
  std::vector<Message> findings;
};

/// Exposure times that all cameras of a rig support.
/// Throws: Error{device} if there are none.
rig::ExposureRange commonRange(const rig::Rig& rig);

/// Photographs full white over the cameras' whole range, black at one exposure, and searches for the exposure
/// at which the 99.5th percentile of the lit pixels is 0.8 of saturation. Highlights that clip there, a
/// caustic or a glint, get a shorter exposure.
/// Several cameras share their exposures: the brightest view decides the shortest, the darkest the longest.
/// Throws: Error{input} for a camera that sees no difference between white and black.
ExposureChoice chooseExposures(rig::ShotTaker& shots, Progress& progress);

}  // namespace relucent::linearization
