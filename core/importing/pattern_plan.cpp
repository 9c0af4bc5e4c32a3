// SPDX-License-Identifier: MIT
#include "relucent/importing/pattern_plan.h"

#include <fmt/format.h>

#include <bit>

#include "relucent/base/error.h"
#include "relucent/base/random.h"

namespace relucent::importing {
namespace {

int bitsFor(int length) {
  return std::bit_width(static_cast<unsigned>(std::max(1, length - 1)));
}

void addGrayCode(std::vector<PlannedPattern>& plan, PlannedPattern::Kind kind, int length) {
  for (int bit = bitsFor(length) - 1; bit >= 0; --bit)
    for (bool negative : {false, true}) {
      PlannedPattern pattern;
      pattern.kind = kind;
      pattern.bit = bit;
      pattern.negative = negative;
      plan.push_back(pattern);
    }
}

bool grayBit(int place, int bit) {
  return (((place ^ (place >> 1)) >> bit) & 1) != 0;
}

bool isLit(const PlannedPattern& pattern, int x, int y) {
  switch (pattern.kind) {
    case PlannedPattern::Kind::columns:
      return grayBit(x, pattern.bit) != pattern.negative;
    case PlannedPattern::Kind::rows:
      return grayBit(y, pattern.bit) != pattern.negative;
    case PlannedPattern::Kind::random: {
      auto column = static_cast<std::uint64_t>(x / pattern.block),
           row = static_cast<std::uint64_t>(y / pattern.block);
      return (Random{pattern.key, row, column}.next() >> 63) != 0;
    }
    default:
      return pattern.kind == PlannedPattern::Kind::white;
  }
}

}  // namespace

std::vector<Message> problems(const PatternPlanSettings& settings) {
  std::vector<Message> found;
  if (settings.projector.width < 8 || settings.projector.height < 8 || settings.projector.width > 8192 ||
      settings.projector.height > 8192)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("import.projector-size-out-of-range",
                                             "a projector of {} pixels is impossible: each side is 8 to 8192")
                        .with(as::size(settings.projector)));
  if (settings.rampLevels < 2 || settings.rampLevels > 65)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("import.ramp-levels-out-of-range", "a ramp has 2 to 65 levels"));
  if (settings.randomPatterns < 0)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("import.random-patterns-negative",
                                             "the number of random patterns cannot be negative"));
  return found;
}

std::string_view toString(PlannedPattern::Kind kind) {
  switch (kind) {
    case PlannedPattern::Kind::black:
      return "black";
    case PlannedPattern::Kind::white:
      return "white";
    case PlannedPattern::Kind::ramp:
      return "ramp";
    case PlannedPattern::Kind::columns:
      return "columns";
    case PlannedPattern::Kind::rows:
      return "rows";
    case PlannedPattern::Kind::random:
      return "random";
  }
  return "";
}

std::vector<PlannedPattern> planPatterns(const PatternPlanSettings& settings) {
  require(problems(settings).empty(), "settings with problems");
  std::vector<PlannedPattern> plan;
  auto add = [&](PlannedPattern::Kind kind) -> PlannedPattern& {
    plan.emplace_back().kind = kind;
    return plan.back();
  };
  add(PlannedPattern::Kind::black);
  add(PlannedPattern::Kind::white);
  for (int channel = 0; channel < 3; ++channel)
    for (int level = 1; level < settings.rampLevels; ++level) {
      PlannedPattern& ramp = add(PlannedPattern::Kind::ramp);
      ramp.channel = channel;
      ramp.level = static_cast<double>(level) / (settings.rampLevels - 1);
    }
  addGrayCode(plan, PlannedPattern::Kind::columns, settings.projector.width);
  addGrayCode(plan, PlannedPattern::Kind::rows, settings.projector.height);
  for (int k = 0; k < settings.randomPatterns; ++k) {
    PlannedPattern& random = add(PlannedPattern::Kind::random);
    random.block = 1 << (k % 4);
    random.key = Random{settings.seed, static_cast<std::uint64_t>(k)}.next();
  }
  add(PlannedPattern::Kind::white);
  add(PlannedPattern::Kind::black);
  return plan;
}

image::Image render(const PlannedPattern& pattern, Size projector) {
  image::Image image(projector, 3);
  for (int y = 0; y < projector.height; ++y)
    for (int x = 0; x < projector.width; ++x)
      for (int c = 0; c < 3; ++c) {
        if (pattern.kind == PlannedPattern::Kind::ramp)
          image.at(x, y, c) = c == pattern.channel ? static_cast<float>(pattern.level) : 0.0f;
        else
          image.at(x, y, c) = isLit(pattern, x, y) ? 1.0f : 0.0f;
      }
  return image;
}

}  // namespace relucent::importing
