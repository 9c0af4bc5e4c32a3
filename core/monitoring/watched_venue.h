// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "relucent/hdr/hdr.h"
#include "relucent/monitoring/sampled_transport.h"
#include "relucent/monitoring/sampling.h"
#include "relucent/rig/rig.h"

namespace relucent::monitoring {

/// What a camera that stays needs to know of its venue, at the sampled pixels alone.
/// Shapes: black and flood three values a sample.
struct WatchedVenue {
  Sampling sampling;
  SampledTransport transport;
  std::vector<float> black, flood;  // e, and T 1
  hdr::CameraModel camera;
  /// How wrong T is: of the predicted light, and of the flood image, which counts where little is predicted.
  double wrong = 0.03, wrongOfFlood = 0.004;
};

/// A photograph at the sampled pixels, radiance with variance. Shapes: three values a sample.
struct Observed {
  std::vector<float> radiance, variance;
  std::vector<std::uint8_t> valid;  // 0: saturated
  double saturated = 0.0;           // share of values that are
};

/// Contract: the frame has the camera's size.
Observed observedOf(const rig::RawFrame& frame, const WatchedVenue& venue);

/// Which of the exposures, longest first, suits a picture: the longest that saturates nearly nothing of it by
/// T p + e, and lasts no longer than `longest`, in which visitors and films move; else the shortest.
/// Contract: there are exposures.
double suitableExposure(const FrameMeans& frame, std::span<const double> exposures, double longest,
                        const WatchedVenue& venue);

}  // namespace relucent::monitoring
