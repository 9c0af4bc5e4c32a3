// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "relucent/monitoring/watched_venue.h"

namespace relucent::monitoring {

/// A frame that was projected.
struct PlayedFrame {
  double since = 0.0;  // seconds, of any clock: when it took the place of the one before
  FrameMeans means;
};

/// What a photograph shows of the frames, by content: of the means over nodes,
///   seen = means + share along,    about share = 0
/// `along` leads to a moment shortly after; empty where nothing changes.
struct Moment {
  std::vector<float> means, along;
  double since = 0.0;   // when its exposure began, on the frames' clock
  double misfit = 0.0;  // mean of min(r^2 / s^2, 9) over the samples that were compared
};

/// Finds which frames a photograph shows, with no other knowledge of its time than that it lies among them:
///  1. every frame's T p at a few hundred samples;
///  2. an exposure of t seconds that begins at s sees the mean of all frames that are lit meanwhile, which is
///     piecewise linear in s. At every bend, that is where s or s + t is the beginning of a frame, the misfit
///     sum min(r^2 / s^2, 9), r = y - e - T p, so that visitors count for little;
///  3. beside the best bends the s of least squares over what fits.
/// `gains`: of the projectors' channels as they are known, three a projector.
/// Contract: frames ascend in time, at least one.
Moment momentOf(const Observed& seen, std::span<const PlayedFrame> frames, double exposureSeconds,
                const WatchedVenue& venue, std::span<const double> gains);

}  // namespace relucent::monitoring
