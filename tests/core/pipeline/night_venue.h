// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "relucent/image/colour.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/night.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/venue/venue.h"

namespace relucent::test {

/// A small corner that is tended every night.
inline venue::VenueSettings nightVenue(const venue::Changes& changes = {}) {
  venue::VenueSettings venue;
  venue.name = "corner";
  venue.projector = {40, 30};
  venue.camera = {32, 24};
  venue.pathsPerPixel = 32;
  venue.changes = changes;
  return venue;
}

inline venue::Changes paintedWall() {
  venue::Changes changes;
  changes.painted.push_back({{0.4, 0.5}, 0.15});
  return changes;
}

/// Measured into `folder`.
inline void measureNightVenue(const std::filesystem::path& folder, const std::filesystem::path& cache) {
  pipeline::CalibrateSettings settings;
  settings.rig = nightVenue();
  settings.linearization.levels = 9;
  Progress quiet;
  pipeline::calibrate(folder, settings, cache, quiet);
}

inline void writeNightPicture(const std::filesystem::path& file) {
  image::writePng(file, image::srgbEncoded(pipeline::standardImages().front().linear), 8);
}

inline pipeline::NightSettings nightSettings(const std::filesystem::path& picture,
                                             const venue::Changes& changes = {}) {
  pipeline::NightSettings settings;
  settings.images = {picture};
  settings.canvas.size = {480, 360};
  settings.photographs = 3;
  settings.rig = nightVenue(changes);
  return settings;
}

}  // namespace relucent::test
