// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "relucent/compensation/methods.h"
#include "relucent/monitoring/watched_venue.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/venue/venue.h"

namespace relucent::pipeline {

/// A simulated venue, measured as any other, and watched by its first camera.
struct RehearsedVenue {
  /// Measures it, in a folder that is gone afterwards.  Throws: as calibrate(), loadCalibration() and
  /// watchedVenueOf().
  RehearsedVenue(const venue::VenueSettings& settings, const std::filesystem::path& cache,
                 Progress& progress);
  RehearsedVenue(const RehearsedVenue&) = delete;  // the compensator looks at what is measured
  RehearsedVenue& operator=(const RehearsedVenue&) = delete;

  MeasuredCalibration measured;
  monitoring::WatchedVenue watched;
  std::optional<compensation::Compensator> compensator;
  std::shared_ptr<const venue::SimulatedVenue> truth;  // for photographs, and whoever judges
};

}  // namespace relucent::pipeline
