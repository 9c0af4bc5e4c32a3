// SPDX-License-Identifier: MIT
#include "relucent/engine/adaptive_range.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"

namespace relucent::engine {
namespace {

// What is left of a way when it counts as gone: less than one code of a projector's 8 bits.
constexpr float nearBrightness = 0.002f, nearLift = 0.0005f;

/// The value below which `share` of them lie. Reorders them.
float quantile(std::vector<float>& values, double share) {
  auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

/// The brightness at which a pixel's content is as bright as it can be shown.
float brightnessFor(const Reach& reach, const std::array<float, 3>& mixed, float brightest) {
  float result = brightest;
  for (std::size_t c = 0; c < 3; ++c)
    if (float wanted = std::max(0.0f, mixed[c]); wanted * result > reach.most[c])
      result = std::max(0.0f, reach.most[c]) / wanted;
  return result;
}

/// The lift at which a pixel's content is as dark as it can be shown.
float liftFor(const Reach& reach, const std::array<float, 3>& mixed, float most) {
  float result = 0.0f;
  for (std::size_t c = 0; c < 3; ++c) {
    float wanted = std::max(0.0f, mixed[c]);
    if (wanted < reach.least[c] && wanted < 1.0f)
      result = std::max(result, std::min(most, (reach.least[c] - wanted) / (1.0f - wanted)));
  }
  return result;
}

/// demandedRange() in memory that is there already.
DisplayRange demanded(const std::vector<Reach>& reach, const std::vector<std::array<float, 3>>& mixed,
                      const AdaptiveRangeSettings& settings, std::vector<float>& brightness,
                      std::vector<float>& lift) {
  if (reach.empty()) return {};
  for (std::size_t i = 0; i < reach.size(); ++i) {
    brightness[i] = brightnessFor(reach[i], mixed[i], static_cast<float>(settings.brightest));
    lift[i] = liftFor(reach[i], mixed[i], static_cast<float>(settings.mostLift));
  }
  double share = settings.outOfReach / 100.0;
  return {std::max(static_cast<float>(settings.dimmest), quantile(brightness, share)),
          quantile(lift, 1.0 - share)};
}

}  // namespace

std::vector<Message> problems(const AdaptiveRangeSettings& settings) {
  std::vector<Message> found;
  if (!(settings.outOfReach >= 0.0 && settings.outOfReach <= 100.0))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("engine.unreachable-share-out-of-range",
                                 "the share of pixels out of reach must lie between 0 and 100 percent"));
  if (!(settings.dimmest > 0.0 && settings.dimmest <= 1.0 && settings.brightest >= 1.0 &&
        settings.brightest <= 100.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE(
        "engine.brightness-range-invalid",
        "the range of brightness must include 1 (unchanged) and lie above 0 and at most at 100"));
  if (!(settings.mostLift >= 0.0 && settings.mostLift < 1.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.black-lift-out-of-range",
                                             "the black lift must lie between 0 and 1"));
  if (!(settings.timeConstant > 0.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("engine.time-constant-not-positive",
                                             "the time constant must be more than 0 seconds"));
  if (!(settings.cut > 0.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("engine.cut-threshold-not-positive",
                                             "the change that counts as a cut must be above 0"));
  return found;
}

DisplayRange demandedRange(const std::vector<Reach>& reach, const std::vector<std::array<float, 3>>& mixed,
                           const AdaptiveRangeSettings& settings) {
  require(reach.size() == mixed.size(), "{} colours for {} pixels", mixed.size(), reach.size());
  std::vector<float> brightness(reach.size()), lift(reach.size());
  return demanded(reach, mixed, settings, brightness, lift);
}

AdaptiveRange::AdaptiveRange(const EngineVenue& engine, const EngineContent& content,
                             const AdaptiveRangeSettings& settings)
    : settings_(settings), look_(engine, content) {
  auto wrong = problems(settings);
  require(wrong.empty(), "adaptive range: {}", fmt::join(wrong, "; "));
  const compensation::MeasuredVenue& venue = engine.venue;
  for (const std::size_t i : look_.cameraPixels()) {
    Reach reach;
    for (std::size_t c = 0; c < 3; ++c) {
      reach.least[c] = venue.black[3 * i + c] / content.white;
      reach.most[c] = (venue.black[3 * i + c] + venue.flood[3 * i + c]) / content.white;
    }
    reach_.push_back(reach);
  }
  lowest_.resize(reach_.size());
  highest_.resize(reach_.size());
}

DisplayRange AdaptiveRange::follow(const ContentFrame& frame, std::chrono::duration<double> elapsed) {
  look_.look(frame);
  DisplayRange goal = demanded(reach_, look_.mixed(), settings_, lowest_, highest_);
  auto left = static_cast<float>(std::exp(-std::max(0.0, elapsed.count()) / settings_.timeConstant));
  float apart = std::log(now_.brightness / goal.brightness) * left;
  float lower = (now_.blackLift - goal.blackLift) * left;
  bool cut = !begun_ || look_.changed() > static_cast<float>(settings_.cut);
  settled_ = cut || (std::abs(apart) < nearBrightness && std::abs(lower) < nearLift);
  now_ = settled_ ? goal : DisplayRange{goal.brightness * std::exp(apart), goal.blackLift + lower};
  begun_ = true;
  return now_;
}

}  // namespace relucent::engine
