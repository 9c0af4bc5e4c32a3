// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/image/image.h"

namespace relucent::sentinels {

/// How a view has moved.
struct Movement {
  double x = 0.0, y = 0.0;  // pixels, of the view's centre
  double degrees = 0.0;
  bool explains = false;  // moving the first picture so leaves less than half of the difference
};

/// The rigid movement that takes `first` to `now`: shift by phase correlation, rotation from the shifts of
/// the four quarters against each other.  Shapes: one channel each, the same size. Source: Kuglin & Hines
/// 1975, as cv::phaseCorrelate.
Movement movementBetween(const image::Image& first, const image::Image& now);

}  // namespace relucent::sentinels
