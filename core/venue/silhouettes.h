// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "relucent/base/raster.h"

namespace relucent::venue {

/// Somebody or something in the way of light, as an ellipse; places and lengths are shares of the raster's
/// width and height.
struct Silhouette {
  std::optional<std::size_t> projector;  // whose light it holds back; none: it stands before the camera
  double x = 0.5, y = 0.5;               // its middle
  double halfWidth = 0.1, halfHeight = 0.3;

  bool holds(Size size, Pixel pixel) const;
};

struct VisitorSettings {
  std::uint64_t seed = 1;
  double everySeconds = 60.0;  // one comes so often, on the average
  std::size_t projectors = 1;  // that he may cast a shadow from
  double longestStop = 15.0;   // seconds that he stands still on his way
};

/// Visitors who walk through a venue: each crosses the camera's view from one side to the other in 4 to 25
/// seconds, every other one stops on the way, and two of three pass through a projector's light too. Who is
/// there at a time depends on the seed alone.
class Visitors {
 public:
  explicit Visitors(const VisitorSettings& settings) : settings_(settings) {}
  std::vector<Silhouette> at(double seconds) const;

 private:
  VisitorSettings settings_;
};

}  // namespace relucent::venue
