// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/engine/content_frame.h"
#include "relucent/engine/engine_plan.h"
#include "relucent/engine/frame_samples.h"

namespace relucent::engine {

struct AdaptiveRangeSettings {
  double outOfReach = 2.0;    // percent of the pixels that may exceed the venue's range on either side
  double dimmest = 0.5;       // least brightness, relative to the target's
  double brightest = 1.5;     // most
  double mostLift = 0.1;      // share of white added to black
  double timeConstant = 1.0;  // time constant, seconds
  double cut = 0.4;           // share of the pixels whose change of brightness marks a scene change
};
std::vector<Message> problems(const AdaptiveRangeSettings& settings);

/// Brightness and offset of a frame, see FrameRequest.
struct DisplayRange {
  float brightness = 1.0f;
  float blackLift = 0.0f;

  bool operator==(const DisplayRange&) const = default;
};

/// The range of a pixel, per channel, relative to the target's white.
struct Reach {
  std::array<float, 3> least{};  // e / white
  std::array<float, 3> most{};   // (T 1 + e) / white
};

/// The range with which content just fits the venue. k = K c, the content in the venue's colour mixing:
///   brightness = the lowest outOfReach % quantile over the pixels of  min_c most_c / k_c,
///   blackLift  = the highest outOfReach % quantile over the pixels of  max_c (least_c - k_c) / (1 - k_c),
/// both limited by the settings. Brighter content never gets a greater brightness or lift.
/// Shapes: as many `mixed` as `reach`. Without pixels: 1 and 0. NaN counts as black.
DisplayRange demandedRange(const std::vector<Reach>& reach, const std::vector<std::array<float, 3>>& mixed,
                           const AdaptiveRangeSettings& settings);

/// Adapts the range to films imperceptibly: exponentially with a time constant, brightness in its logarithm,
///   x(t + dt) = x* + (x(t) - x*) exp(-dt / timeConstant),
/// stops when it has almost converged, so that a still picture settles, and jumps at a scene change, where
/// the histogram of brightness (32 classes of its square root) changes by more than `cut`: 1/2 sum |h - h'|.
class AdaptiveRange {
 public:
  /// `engine` and `content` must outlive it. Samples a few thousand camera pixels on a regular grid.
  /// Throws: std::logic_error for wrong settings.
  AdaptiveRange(const EngineVenue& engine, const EngineContent& content,
                const AdaptiveRangeSettings& settings = {});

  /// The range of a frame that is shown `elapsed` after the previous one. Allocates nothing.
  /// Contract: the frame has the content's size.
  DisplayRange follow(const ContentFrame& frame, std::chrono::duration<double> elapsed);
  /// Whether the same frame would get the same range again.
  bool settled() const { return settled_; }

 private:
  AdaptiveRangeSettings settings_;
  FrameSamples look_;
  std::vector<Reach> reach_;
  std::vector<float> lowest_, highest_;
  DisplayRange now_;
  bool begun_ = false, settled_ = true;
};

}  // namespace relucent::engine
