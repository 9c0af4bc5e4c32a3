// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/rig/shot.h"

namespace relucent::linearization {

/// Exposures that suit a venue.
struct ExposureChoice {
  std::vector<double> seconds;     // longest first
  std::vector<double> saturation;  // per camera: signals from this value on are saturated
  /// Of `seconds`: those that the cameras need for light as bright as the flood image, one or more, ...
  std::vector<double> flood;
  /// ... and for light that is dimmer by `dimmerBy` or more; the same where the cameras have no longer ones.
  std::vector<double> dim;
  double dimmerBy = 1.0;
  std::vector<Message> findings;
  /// The photographs that this took, in their order: white at every time of `seconds` and at some others, and
  /// black at one.
  std::vector<rig::Shot> whites;
  rig::Shot black;
};

/// Exposure times that all cameras of a rig support.
/// Throws: Error{device} if there are none.
rig::ExposureRange commonRange(const rig::Rig& rig);

/// Photographs full white, at first in the middle of the cameras' range, and moves on until the 99.5th
/// percentile of the lit pixels is 0.8 of saturation; black once on the way, to tell what is lit. Highlights
/// that clip there, a caustic or a glint, get a shorter exposure.
/// Several cameras share their exposures: the brightest view decides the shortest, the darkest the longest.
/// `unit`: every exposure is a whole multiple of it, seconds, as far as the cameras' range allows; 0: any.
/// Throws: Error{input} for a camera that sees no difference between white and black.
ExposureChoice chooseExposures(rig::ShotTaker& shots, Progress& progress, double unit = 0.0);

/// What photographs of one pattern show at the exposures of `seconds`, as one shot, the longest first; none
/// if one of them was not photographed.
std::optional<rig::Shot> atExposures(const std::vector<rig::Shot>& shots, std::vector<double> seconds);

}  // namespace relucent::linearization
