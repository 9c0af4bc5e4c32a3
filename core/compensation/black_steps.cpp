// SPDX-License-Identifier: MIT
#include "relucent/compensation/black_steps.h"

#include <algorithm>

namespace relucent::compensation {

Seams blackSteps(const MeasuredVenue& venue, const Target& target, const SeamPairs& pairs, double lift) {
  CameraStack seen = venue.black;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (target.inside[i / 3] != 0)
      seen[i] = std::max(seen[i], target.white[i % 3] * static_cast<float>(lift));
  return seamsOf(seen, venue.transport.cameras(), target.inside, target.white, pairs);
}

double leastBlackLift(const MeasuredVenue& venue, const Target& target, const SeamPairs& pairs, double seen,
                      double most) {
  // What is uneven beside the edges decides nothing here, and takes long.
  const SeamPairs edges{pairs.across, pairs.stretch, {}};
  const auto isSeen = [&](double lift) { return blackSteps(venue, target, edges, lift).p95 > seen; };
  if (pairs.across.empty() || !isSeen(0.0)) return 0.0;
  if (isSeen(most)) return 0.0;
  constexpr double accuracy = 1e-4;
  double low = 0.0, high = most;
  while (high - low > accuracy) {
    const double middle = 0.5 * (low + high);
    (isSeen(middle) ? low : high) = middle;
  }
  return high;
}

double leastBlackLift(const MeasuredVenue& venue, const Target& target) {
  if (venue.transport.projectors().devices() < 2) return 0.0;
  return leastBlackLift(venue, target, seamPairs(venue.transport, target.inside, seamApart, {}));
}

}  // namespace relucent::compensation
