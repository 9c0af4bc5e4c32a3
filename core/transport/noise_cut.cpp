// SPDX-License-Identifier: MIT
#include "relucent/transport/noise_cut.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace relucent::transport {

double noiseCut(const Acquisition& acquisition, double sigmas) {
  std::vector<float> variances;
  for (std::size_t row = 0; 3 * row < acquisition.leafVariance.size(); ++row) {
    const bool isFlagged = row < acquisition.flagged.size() && acquisition.flagged[row] != 0;
    float light = 0.0f, variance = 0.0f;
    for (std::size_t i = 3 * row; i < 3 * row + 3; ++i) {
      light = std::max(light, acquisition.flood[i]);
      variance = std::max(variance, acquisition.leafVariance[i]);
    }
    if (!isFlagged && light > 0.0f) variances.push_back(variance);
  }
  if (variances.empty()) return 0.0;
  auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  return sigmas * std::sqrt(static_cast<double>(std::max(0.0f, *middle)));
}

}  // namespace relucent::transport
