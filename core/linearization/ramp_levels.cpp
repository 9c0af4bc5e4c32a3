// SPDX-License-Identifier: MIT
#include "relucent/linearization/ramp_levels.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relucent::linearization {

std::vector<double> rampLevels(const LinearizationSettings& settings, int bits) {
  double codes = std::ldexp(1.0, bits) - 1.0;
  std::vector<double> levels;
  for (int k = 1; k < settings.levels; ++k) {
    double drive = std::pow(static_cast<double>(k) / (settings.levels - 1), settings.shadowPower);
    double code = std::round(drive * codes);
    if (code > 0.0 && (levels.empty() || code / codes > levels.back())) levels.push_back(code / codes);
  }
  return levels;
}

LevelQueue::LevelQueue(std::size_t levels, std::size_t groups, Random random)
    : groups_(groups), random_(random) {
  for (std::deque<std::size_t>& channel : open_)
    for (std::size_t level = levels; level-- > 1;) channel.push_back(level);
}

bool LevelQueue::isOpen() const {
  return std::ranges::any_of(open_, [](const auto& channel) { return !channel.empty(); });
}

void LevelQueue::show(MosaicLevels& levels, std::size_t channel, bool reference, std::size_t full,
                      const std::function<bool(std::size_t)>& wanted) {
  std::vector<std::size_t> groups(groups_);
  for (std::size_t i = 0; i < groups.size(); ++i) groups[i] = i;
  for (std::size_t i = groups.size(); i > 1; --i) std::swap(groups[i - 1], groups[random_.below(i)]);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    std::size_t& level = levels[3 * groups[i] + channel];
    if (i == 0 && reference)
      level = full;
    else if (!open_[channel].empty() && wanted(open_[channel].front())) {
      level = open_[channel].front();
      open_[channel].pop_front();
    }
  }
}

}  // namespace relucent::linearization
