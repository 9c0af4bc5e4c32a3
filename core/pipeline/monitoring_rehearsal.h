// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relucent/monitoring/monitor.h"
#include "relucent/pipeline/rehearsed_content.h"
#include "relucent/venue/played_show.h"
#include "relucent/venue/venue.h"

namespace relucent::pipeline {

struct RehearsalSettings {
  venue::VenueSettings venue;   // as it was measured
  double interval = 2.0;        // seconds between photographs
  double latency = 0.08;        // seconds from a frame's passing on to its light; it varies by as much
  double visitorsEvery = 60.0;  // seconds; 0: there are none
  std::uint64_t seed = 1;       // of visitors, latency and noise
};

/// What becomes of a venue while it is watched.
struct RehearsedTrouble {
  double at = 120.0;                          // seconds from the beginning
  double until = 1e12;                        // likewise: then it is put right
  std::optional<venue::Changes> changes{};    // from then on
  std::vector<std::array<float, 3>> lamps{};  // what is left from then on; empty: all
  std::vector<venue::Silhouette> shadows{};   // from then on
  std::optional<monitoring::FindingKind> expected{};
};

/// What the venue goes through anyhow, from the beginning to the end.
struct RehearsedDay {
  double lampDrift = 0.0;  // share of light that is lost by the end
  double dusk = 0.0;       // share of its room light that goes, along a cosine, and comes back
};

struct ToldFinding {
  double seconds = 0.0;
  monitoring::Finding finding;
};

struct RehearsalResult {
  std::vector<ToldFinding> told;             // whenever a finding appears
  std::vector<monitoring::Finding> lasting;  // at the end
  int photographs = 0, used = 0, saturated = 0, unrecognised = 0;
  double seconds = 0.0;   // of the monitor's work, all photographs
  std::size_t bytes = 0;  // of sampled T
  double offBy = 0.0;     // median of |moment found - true moment|, seconds, where the content changes
  std::vector<double> gainLow, gainHigh;  // per projector: 1st and 99th percentile of single photographs'
  double shift = 0.0;                     // 99th percentile of single photographs' |shift|
  /// Whether the trouble was told, after how many seconds; and all that should not have been.
  std::optional<double> toldAfter(const RehearsedTrouble& trouble) const;
  std::vector<ToldFinding> falseAlarms(const RehearsedTrouble& trouble) const;
};

/// A simulated venue, measured, before which the monitor is tried by simulated photographs of simulated
/// shows: what the benchmark and tests share.
class MonitoringRehearsal {
 public:
  /// Measures the venue. Throws: as calibrate().
  MonitoringRehearsal(const RehearsalSettings& settings, const std::filesystem::path& cache,
                      Progress& progress);
  ~MonitoringRehearsal();

  /// `duration`: seconds. Throws: as SimulatedVenue, for changes; Cancelled.
  RehearsalResult run(ShownContent content, double duration, const RehearsedTrouble& trouble,
                      const RehearsedDay& day, Progress& progress);
  /// With other visitors and noise from now on.
  void setSeed(std::uint64_t seed);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace relucent::pipeline
