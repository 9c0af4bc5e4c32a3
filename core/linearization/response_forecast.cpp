// SPDX-License-Identifier: MIT
#include "relucent/linearization/response_forecast.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace relucent::linearization {

ResponseForecast::ResponseForecast(const ShownLevels& shown, std::size_t projector, LevelLights light)
    : drives_(shown.drives[projector]), light_(std::move(light)) {
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<bool>& seen = seen_[c];
    seen.assign(drives_.size(), false);
    seen.back() = true;
    for (const MosaicShot& shot : shown.what)
      for (std::size_t group = 0; group < mosaicGroups; ++group)
        if (std::size_t level = shot.level[projector][3 * group + c]; level > 0) seen[level - 1] = true;
  }
}

double ResponseForecast::lightAt(std::size_t channel, double drive) const {
  std::optional<std::size_t> low, next;
  for (std::size_t k = drives_.size(); k-- > 0;) {
    if (!seen_[channel][k]) continue;
    next = low;
    low = k;
  }
  if (!next) return 1.0;
  double dark = std::max(light_[channel][*low], 1e-6), bright = std::max(light_[channel][*next], 1e-6);
  double exponent = std::clamp(std::log(bright / dark) / std::log(drives_[*next] / drives_[*low]), 0.3, 6.0);
  return dark * std::pow(drive / drives_[*low], exponent);
}

}  // namespace relucent::linearization
