// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace relucent {

/// How playing goes, over the last seconds.
struct PlayerStatistics {
  double framesPerSecond = 0.0;  // that reached the windows; 0 while a still picture stands
  double frameSeconds = 0.0;     // one frame's computation, the mean
  double clipped = 0.0;          // of the last frame
  int steps = 0;                 // of refinement, of the last frame
  std::uint64_t frames = 0;      // since it began
  std::uint64_t late = 0;  // of these, ready later than one refresh of the display after they were begun
};

}  // namespace relucent
