// SPDX-License-Identifier: MIT
#include "relucent/monitoring/monitor.h"

#include <utility>

#include "relucent/base/require.h"

namespace relucent::monitoring {
namespace {

constexpr double mostSaturated = 0.2;  // share of values

}  // namespace

Monitor::Monitor(WatchedVenue venue, MonitorSettings settings)
    : venue_(std::move(venue)),
      settings_(settings),
      judgement_(venue_.transport.projectors(), venue_.sampling.cells, settings) {
  require(venue_.transport.rows() == venue_.sampling.pixels.size(), "{} rows for {} samples",
          venue_.transport.rows(), venue_.sampling.pixels.size());
}

Look Monitor::look(const rig::RawFrame& photograph, double seconds, std::span<const PlayedFrame> frames) {
  Look look;
  const Observed seen = observedOf(photograph, venue_);
  if (seen.saturated > mostSaturated) {
    look.use = Look::Use::saturated;
    return look;
  }
  look.moment = momentOf(seen, frames, hdr::trueSeconds(venue_.camera, photograph.seconds), venue_, gains());
  look.light = fitLight(seen, look.moment, venue_);
  if (look.light.recognised < settings_.recognised)
    look.use = Look::Use::unrecognised;
  else if (look.light.light > settings_.lit)
    look.shift = viewShift(seen, look.light.predicted, look.light.along, venue_);
  judgement_.add(look, seconds);
  return look;
}

}  // namespace relucent::monitoring
