// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/image/image.h"

namespace relucent::importing {

struct PatternPlanSettings {
  Size projector;
  int rampLevels = 8;      // of each channel, black and full included
  int randomPatterns = 8;  // binary, block sizes 1, 2, 4, 8 in turn
  std::uint64_t seed = 1;
};
std::vector<Message> problems(const PatternPlanSettings& settings);

/// One picture of a plan.
struct PlannedPattern {
  enum class Kind { black, white, ramp, columns, rows, random };
  Kind kind = Kind::black;
  int channel = 0;  // ramp: 0 red, 1 green, 2 blue
  int bit = 0;      // columns, rows: of the Gray code, 0 the finest
  bool negative = false;
  int block = 1;          // random: side of its blocks in pixels
  double level = 0.0;     // ramp: encoded drive
  std::uint64_t key = 0;  // random
};
std::string_view toString(PlannedPattern::Kind kind);

/// A fixed sequence that tells everything an import asks for, whatever the camera sees: black and white at
/// both ends, ramps of each channel (response and mixing), Gray-code columns and rows with their negatives
/// [INO] (where light comes from), random patterns (what is held out, and light that goes several ways).
std::vector<PlannedPattern> planPatterns(const PatternPlanSettings& settings);

/// The picture itself: encoded drive, three channels.
image::Image render(const PlannedPattern& pattern, Size projector);

}  // namespace relucent::importing
