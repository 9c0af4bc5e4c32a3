// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/message.h"
#include "compensation/method.h"
#include "compensation/target.h"

namespace relucent {

/// What is shown in a calibrated venue, and how.
struct ContentSettings {
  std::string picture;  // a file; empty: the product's own
  Method method = Method::refined;
  double reachablePercentile = 15.0;  // as TargetSettings
  double blackLift = 0.0;
  Fit fit = Fit::fit;
  std::optional<Corners> corners;  // as TargetSettings

  bool operator==(const ContentSettings&) const = default;
};
std::vector<Message> problems(const ContentSettings& settings);
/// How content is fitted that was decided on so.
TargetSettings targetOf(const ContentSettings& settings);

}  // namespace relucent
