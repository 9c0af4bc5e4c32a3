// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/transport/statistics.h"

namespace relucent::transport {

/// What a cut at one strength would leave, as the histogram of all of T has it, without looking at T: bins
/// wholly or in the part of their width, in log10 of strength, that lies above the cut.
///   kept = sum_bins clamp((log10 high - log10 cut) / (log10 high - log10 low), 0, 1) * bin
/// Bytes shrink as leaves do.
TransportStatistics estimatedAfterCut(const TransportStatistics& whole, double cut);

}  // namespace relucent::transport
