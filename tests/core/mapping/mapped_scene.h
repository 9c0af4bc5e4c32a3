// SPDX-License-Identifier: MIT
#pragma once

#include "core/compensation/stacked_views.h"
#include "relucent/inverse/windows.h"
#include "relucent/mapping/projector_maps.h"

namespace relucent::synthetic {

/// A made-up venue and what is prepared for it.
struct MappedScene {
  SceneSettings settings;
  compensation::MeasuredVenue venue;
  inverse::WindowInverse inverse;

  explicit MappedScene(const SceneSettings& wanted)
      : settings(wanted), venue(stackedViews({makeScene(wanted)})) {
    Progress quiet;
    inverse = inverse::computeWindows(venue.transport, venue.usable, {}, quiet);
  }
  /// Which place of the projector's picture the middle of a camera pixel sees, as makeScene() has it.
  std::array<double, 2> seenBy(Pixel pixel) const {
    const double span = 1.0 + 2.0 * settings.margin;
    const double bend = 3.0 * (cloud(pixel.x, pixel.y, settings.seed * 100 + 7, 1, 64.0) - 0.5);
    return {
        ((pixel.x + 0.5) * span / settings.camera.width - settings.margin) * settings.projector.width + bend,
        ((pixel.y + 0.5) * span / settings.camera.height - settings.margin) * settings.projector.height -
            bend};
  }
  /// Projector pixels a camera pixel, both ways.
  std::array<double, 2> pitch() const {
    const double span = 1.0 + 2.0 * settings.margin;
    return {span * settings.projector.width / settings.camera.width,
            span * settings.projector.height / settings.camera.height};
  }
};

}  // namespace relucent::synthetic
