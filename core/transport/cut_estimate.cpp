// SPDX-License-Identifier: MIT
#include "relucent/transport/cut_estimate.h"

#include <algorithm>
#include <cmath>

namespace relucent::transport {

TransportStatistics estimatedAfterCut(const TransportStatistics& whole, double cut) {
  if (!(cut > 0.0)) return whole;
  TransportStatistics kept = whole;
  double energy = 0.0, leaves = 0.0, connections = 0.0, all = 0.0;
  for (std::size_t bin = 0; bin < StrengthHistogram::bins; ++bin) {
    double low = std::log10(strengthOfBin(bin)), high = low + 1.0 / StrengthHistogram::binsPerDecade;
    const double share = std::clamp((high - std::log10(cut)) / (high - low), 0.0, 1.0);
    energy += share * whole.histogram.energy[bin];
    leaves += share * static_cast<double>(whole.histogram.leaves[bin]);
    const double whatStays = share * static_cast<double>(whole.histogram.connections[bin]);
    connections += whatStays;
    kept.histogram.connections[bin] = static_cast<std::uint64_t>(whatStays);
    all += whole.histogram.energy[bin];
    kept.histogram.energy[bin] *= share;
    kept.histogram.leaves[bin] =
        static_cast<std::uint64_t>(share * static_cast<double>(whole.histogram.leaves[bin]));
  }
  if (all > 0.0) kept.energyKept = energy / all;
  double left = whole.leaves > 0 ? leaves / static_cast<double>(whole.leaves) : 1.0;
  kept.leaves = static_cast<std::uint64_t>(leaves);
  kept.bytes = static_cast<std::uint64_t>(left * static_cast<double>(whole.bytes));
  kept.connections = static_cast<std::uint64_t>(connections);
  return kept;
}

}  // namespace relucent::transport
