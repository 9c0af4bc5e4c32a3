// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "relucent/image/image.h"
#include "relucent/rig/rig.h"
#include "relucent/venue/silhouettes.h"
#include "relucent/venue/venue.h"

namespace relucent::venue {

/// What a show sends the projectors: encoded drive, one picture each.
using PlayedPictures = std::shared_ptr<const std::vector<image::Image>>;

/// A show in a simulated venue: what plays when, in seconds. Pictures that are alike are one pointer: what
/// the camera sees of them is kept.
struct PlayedShow {
  double framesPerSecond = 25.0;
  /// Of frame `number`, which is lit from number / framesPerSecond on. Called by who photographs.
  std::function<PlayedPictures(std::int64_t number)> pictures;
};

/// What a venue has become at a time.
struct PlayedVenue {
  std::shared_ptr<const SimulatedVenue> venue;
  /// What is left of each projector's light, per channel; empty: all of it.
  std::vector<std::array<float, 3>> lamps;
  /// How much more room light there is than the venue has, relative to what it has.
  float moreRoomLight = 0.0f;
  std::vector<Silhouette> inTheWay;
};
using VenueAt = std::function<PlayedVenue(double seconds)>;

/// A camera before a show: an exposure that begins at `clock` sees the mean light of all frames that are lit
/// while it lasts. Keeps what it sees of the last pictures.
/// Contract: all venues have the same rasters and devices.
std::unique_ptr<rig::Camera> cameraBeforeShow(PlayedShow show, VenueAt venueAt, std::function<double()> clock,
                                              std::size_t camera = 0);

/// What that camera would measure of pictures without noise, past whoever stands in the projectors' light;
/// nobody stands before it. Camera signal per second. For evaluation and tests only.
CameraStack trueLight(const std::vector<image::Image>& pictures, const PlayedVenue& now,
                      std::size_t camera = 0);

}  // namespace relucent::venue
