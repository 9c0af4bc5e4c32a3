// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/transport/acquisition.h"

namespace relucent::transport {

/// A cut below which leaves of a typical row are noise rather than light,
///   sigmas * sqrt(median over rows of the largest channel's variance of a leaf).
/// Rows without light and flagged ones do not count. 0: the measurement does not know its noise.
/// Units: camera signal per second, as ThresholdSettings::absolute.
double noiseCut(const Acquisition& acquisition, double sigmas = 3.0);

}  // namespace relucent::transport
