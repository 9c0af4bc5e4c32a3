// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/base/progress.h"
#include "relucent/compensation/target.h"
#include "relucent/engine/fallback_backend.h"

namespace relucent::engine {

/// What a frame takes on this machine, with whatever the engine chooses to compute it.
struct FrameCost {
  std::string device;
  double seconds = 0.0;      // without refinement steps: the fewest that films have
  double stepSeconds = 0.0;  // each step on top
};

/// Times frames of noise of `content` pixels with a venue's own light transport. Its windows are made for
/// that with the usual ridge: another one takes as long.
/// Throws: as computeWindows() and makeBackend(); Cancelled.
FrameCost measureFrameCost(const compensation::MeasuredVenue& venue, Size content, Progress& progress,
                           BackendChoice choice = BackendChoice::automatic);

}  // namespace relucent::engine
