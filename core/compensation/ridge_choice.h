// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/base/progress.h"
#include "relucent/compensation/target.h"
#include "relucent/inverse/windows.h"

namespace relucent::compensation {

/// Result of the windows with one ridge.
struct RidgeTrial {
  double ridge = 0.0;
  double psnr = 0.0;  // dB, `windows` through T, mean over the pictures, where it was tried
  bool operator==(const RidgeTrial&) const = default;
};

struct RidgeChoice {
  double ridge = 0.0;
  std::vector<RidgeTrial> curve;   // ridge ascending; empty where nothing could be compensated
  inverse::WindowInverse inverse;  // with that ridge
};

/// Finds the ridge of the windows by search: pictures with natural statistics are compensated, clamped to the
/// projector's range, and simulated with T. Too small a ridge requires light below black and above white, too
/// large a one leaves defocus; the optimum depends on the venue.
///  1. From settings.ridge in factors of 2, upwards and downwards, as long as the mean PSNR over the
///     reachable pixels grows; within 1/16 and 16 times settings.ridge.
///  2. Of those within 0.1 dB of the best the largest: T's own errors, which the trial cannot show, call for
///     more ridge, never for less.
/// Of many tiles some are tried, about `triedTiles` of them in squares all over the projectors, the others
/// having settings.ridge; the PSNR is then that of the camera pixels whose windows are all among them, in one
/// picture.
/// A venue without a lit part that content would fit into keeps settings.ridge.
/// Throws: as computeWindows().
RidgeChoice chooseRidge(const MeasuredVenue& venue, const inverse::WindowSettings& settings,
                        Progress& progress, std::size_t triedTiles = 8192);

}  // namespace relucent::compensation
