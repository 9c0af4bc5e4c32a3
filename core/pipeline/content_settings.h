// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/compensation/method.h"
#include "relucent/compensation/target.h"

namespace relucent::pipeline {

/// What is shown in a calibrated venue, and how.
struct ContentSettings {
  std::string picture;  // a file; empty: the product's own
  compensation::Method method = compensation::Method::refined;
  double reachablePercentile = 15.0;  // as TargetSettings
  std::optional<double> blackLift{};
  compensation::Brightness brightness = compensation::Brightness::even;
  compensation::Objective objective = compensation::Objective::seen;
  compensation::Clipping clipping = compensation::Clipping::channels;
  compensation::Fit fit = compensation::Fit::fit;
  std::optional<compensation::Corners> corners;  // as TargetSettings
  std::vector<compensation::ViewSettings> views;
  std::optional<compensation::Position> viewer{};
  std::vector<compensation::Mask> masks{};  // where nothing is to be lit

  bool operator==(const ContentSettings&) const = default;
};
std::vector<Message> problems(const ContentSettings& settings);
/// How content is fitted that was decided on so.
compensation::TargetSettings targetOf(const ContentSettings& settings);

}  // namespace relucent::pipeline
