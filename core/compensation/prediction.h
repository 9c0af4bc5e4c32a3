// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/compensation/methods.h"
#include "relucent/image/image.h"

namespace relucent::compensation {

/// How far what one camera sees is from what is wanted there.
struct ViewError {
  image::Image deltaE;         // CIEDE2000 of its pixels; NaN outside the content
  double meanDeltaE = 0.0;     // over the content, as a viewer adapted to its white sees it; 0: there is none
  double psnrReachable = 0.0;  // dB over the reachable pixels; infinite without error, NaN if there are none
  double reachable = 0.0;      // share of the content's pixels
};
/// Shapes: `seen` and `target` of `cameras`.
ViewError errorIn(std::size_t camera, const CameraStack& seen, const Target& target, const Rasters& cameras);

/// The predicted camera images, and their error as the first camera sees it.
struct Prediction {
  CameraStack camera;          // T p + e
  image::Image deltaE;         // CIEDE2000 of the first camera's pixels; NaN outside the content
  double meanDeltaE = 0.0;     // over the content, as a viewer adapted to its white sees it
  double psnrReachable = 0.0;  // dB over the reachable pixels; infinite without error, NaN if there are none
  double reachable = 0.0;      // share of the content's pixels
  double clipped = 0.0;        // share of the content's projector values that were cut off
};

/// The error of given camera images. `clipped` stays 0.
/// Shapes: `camera` and `target` of `cameras`. Content that covers no pixel has a mean of 0.
Prediction compared(CameraStack camera, const Target& target, const Rasters& cameras);

/// The preview of a compensation, assuming that T is exact: all of it that was measured, where the venue
/// keeps that (MeasuredVenue::uncut), so that light which a threshold left out counts against it. Shapes:
/// `compensation` and `target` of the venue. Content that covers no pixel has a mean of 0.
Prediction predict(const MeasuredVenue& venue, const Target& target, const Compensation& compensation);

}  // namespace relucent::compensation
