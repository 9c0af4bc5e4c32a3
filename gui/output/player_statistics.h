// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace relucent::gui {

/// Statistics of the last seconds of playing.
struct PlayerStatistics {
  double framesPerSecond = 0.0;  // that reached the windows; 0 for a still picture
  double frameSeconds = 0.0;     // mean computation of one frame
  double clipped = 0.0;          // of the last frame
  int steps = 0;                 // of refinement, of the last frame
  std::uint64_t frames = 0;      // since it began
  std::uint64_t late = 0;        // of these, finished more than one refresh of the display after their start
  // The longest that a viewer who moved has waited for his picture, up to when windows had it, which show it
  // with their next refresh; 0: nobody has moved.
  double viewerSeconds = 0.0;
  bool perfected = false;  // the last frame is a picture that photographs of it corrected
  // The longest from a live picture's arrival at this computer until windows had it; 0: none plays.
  double liveSeconds = 0.0;
};

}  // namespace relucent::gui
