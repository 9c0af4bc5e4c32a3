// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "relucent/compensation/target.h"

namespace relucent::compensation {

/// How bright white can be, for any weights of the views: the brightest signal of all channels that a share
/// of the usable pixels inside, each counted by the weight of its view, cannot show. Sorted once.
class WhiteLevels {
 public:
  WhiteLevels(const MeasuredVenue& venue, const CameraMask& inside);

  /// `viewWeights`: per camera; views of weight 0 are not asked. With equal weights the first pixel whose
  /// rank is not less than that share of the last one's.  Throws: Error{input} if no view has a pixel, or
  /// some colour hardly reaches the cameras.
  float at(std::span<const float> viewWeights, double percentile) const;
  /// Whether it does not throw for that view alone.
  bool isPossible(std::size_t view, double percentile) const;

 private:
  std::vector<std::vector<float>> most_;  // per camera, sorted: min over channels of T 1 + e
};

}  // namespace relucent::compensation
