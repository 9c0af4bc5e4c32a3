// SPDX-License-Identifier: MIT
#include "relucent/multiplexing/learning.h"

#include <algorithm>
#include <cmath>

namespace relucent::multiplexing {
namespace {

// Mixing never leaves this range about the flood's: it would rather be noise.
constexpr float leastColour = 0.2f, mostColour = 3.0f;
// A share of the pixel's light that says as much about the mixing as the flood does.
constexpr float tellingLight = 0.02f;

transport::ColourBlock mixingOf(const transport::ColourBlock& sum, const transport::ColourBlock& flood,
                                float anyColour) {
  float light = std::clamp(sum.sum() / 3.0f, 0.0f, 1.0f);
  float doubt = tellingLight + 0.01f / std::sqrt(std::max(light, 1e-3f));
  float trust = light / (light + doubt);
  transport::ColourBlock own = sum / std::max(light, tellingLight);
  transport::ColourBlock mixed = trust * own + (1.0f - trust) * flood;
  return mixed.cwiseMax(leastColour * flood)
      .cwiseMin((mostColour * flood).array().matrix() + transport::ColourBlock::Constant(anyColour));
}

}  // namespace

void learn(Row& row, const RowFit& fit, const std::vector<transport::ColourBlock>& floodMixing,
           const RowSettings& settings) {
  float least = settings.leastExcess * settings.leastExcess, most = settings.mostExcess * settings.mostExcess;
  row.excess = std::clamp((fit.noise + row.excess) * fit.misfit - fit.noise, least, most);
  for (std::size_t kind = 0; kind < row.mixing.size(); ++kind)
    row.mixing[kind] = mixingOf(fit.sums[kind], floodMixing[kind / 2], settings.anyColour);
  for (Leaf& leaf : row.leaves) {
    float light = std::max<float>(0.0f, leaf.light);
    float spread = std::hypot(light, static_cast<float>(leaf.deviation), settings.faintest);
    float most_ = std::max(1.5f * std::abs(leaf.light) + 2.0f * leaf.deviation, settings.faintest);
    leaf.spread = std::min(spread, most_);
    leaf.expected = 0.0f;
  }
}

}  // namespace relucent::multiplexing
