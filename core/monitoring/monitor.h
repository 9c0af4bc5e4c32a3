// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "relucent/monitoring/judgement.h"
#include "relucent/monitoring/watched_venue.h"

namespace relucent::monitoring {

/// Watches a venue by photographs of what plays, without patterns. Each photograph is compared with T p + e
/// of the frames lately projected (momentOf, fitLight, viewShift); what lasts is told. Photographs cost the
/// same whatever the camera's size, and no memory grows.
class Monitor {
 public:
  explicit Monitor(WatchedVenue venue, MonitorSettings settings = {});

  const WatchedVenue& venue() const { return venue_; }
  /// A photograph whose exposure began among these frames. `seconds`: when, of any clock that goes on.
  /// Contract: at least one frame; the frame has the camera's size.
  Look look(const rig::RawFrame& photograph, double seconds, std::span<const PlayedFrame> frames);
  /// Of the projectors' channels as far as photographs tell them, three a projector: 1 as they were measured.
  std::vector<double> gains() const { return judgement_.gains(); }
  /// What lasts as of the last photograph, the gravest first.
  const std::vector<Finding>& findings() const { return judgement_.findings(); }
  /// Share of all quantities that the photographs of the last seconds tell: 0 in the dark.
  double informed() const { return judgement_.informed(); }
  /// Something else was shown, or nothing: what was seen before does not count.
  void forget() { judgement_.forget(); }

 private:
  WatchedVenue venue_;
  MonitorSettings settings_;
  Judgement judgement_;
};

}  // namespace relucent::monitoring
