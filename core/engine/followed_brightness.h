// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <vector>

#include "relucent/compensation/brightness.h"
#include "relucent/engine/frame_samples.h"

namespace relucent::engine {

/// Gains of white that follow a film imperceptibly. Every cell goes towards those of the frame,
/// compensation::BrightnessFit's, exponentially in its logarithm:
///   x(t + dt) = x* + (x(t) - x*) exp(-dt / 1 s)
/// stops when it has almost arrived, so that a still picture settles, and jumps where a new scene begins, see
/// FrameSamples::changed().
class FollowedBrightness {
 public:
  /// `engine` and `content` must outlive it.
  FollowedBrightness(const EngineVenue& engine, const EngineContent& content, compensation::Brightness way);

  /// The gains of a frame that is shown `elapsed` after the previous one. Allocates nothing.
  /// Contract: the frame has the content's size.
  const compensation::BrightnessField& follow(const ContentFrame& frame,
                                              std::chrono::duration<double> elapsed);
  /// Whether the same frame would get the same gains again.
  bool settled() const { return settled_; }

 private:
  FrameSamples look_;
  compensation::BrightnessFit fit_;
  std::vector<compensation::BrightnessSample> samples_;
  compensation::BrightnessField now_;
  bool begun_ = false, settled_ = true;
};

}  // namespace relucent::engine
