// SPDX-License-Identifier: MIT
#include "relucent/calibration/earlier_shots.h"

#include <algorithm>
#include <chrono>

namespace relucent::calibration {

std::optional<rig::Shot> EarlierShots::find(const rig::ShotId& id, const std::string& fingerprint) {
  std::optional<rig::Shot> shot = journal_.find(id, fingerprint);
  // After an alarm shots of this session are found as well.
  if (shot)
    if (const auto kept = journal_.keptAt(id, fingerprint); kept && *kept < begin_) kept_.push_back(*kept);
  return shot;
}

double EarlierShots::seconds() const {
  auto kept = kept_;
  std::erase_if(kept, [this](Moment moment) { return moment <= recordedUntil_; });
  std::ranges::sort(kept);
  std::chrono::duration<double> sum(kept_.empty() ? 0.0 : recorded_);
  for (std::size_t i = 1; i < kept.size(); ++i)
    if (const auto between = kept[i] - kept[i - 1]; between < longestBetween) sum += between;
  return sum.count();
}

}  // namespace relucent::calibration
