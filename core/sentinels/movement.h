// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

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

/// Two pictures of one view, one channel each.
struct ViewPair {
  image::Image first, now;
  std::vector<std::uint8_t> compared = {};  // pixels that hold light in both, 0 elsewhere; empty: all do
};
/// The one rigid movement that takes all first pictures to those of now, each as bright as it may be: from
/// what is found of each pair, the least sum of
///   min over g |now - g moved(first)|^2 / |now|^2
/// by Gauss and Newton's steps, over pixels that are compared and come from such pixels, the pictures'
/// borders left out.  Shapes: all pairs' the same, not empty.
Movement movementBetween(const std::vector<ViewPair>& views);

}  // namespace relucent::sentinels
