// SPDX-License-Identifier: MIT
#include "engine/drive_encoder.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "engine/blue_noise.h"

namespace relucent {
namespace {

/// Bayer 1973: the threshold of (x, y) from the bits of x xor y and y, finest first.
std::vector<float> orderedThresholds(int side) {
  std::vector<float> thresholds;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      int rank = 0;
      for (int bit = 0; bit < 3; ++bit) rank = 4 * rank + 2 * (((x ^ y) >> bit) & 1) + ((y >> bit) & 1);
      thresholds.push_back((static_cast<float>(rank) + 0.5f) / 64.0f);
    }
  }
  return thresholds;
}

}  // namespace

DriveEncoder::DriveEncoder(const ProjectorResponse& response, int bits, Dither dither) : bits_(bits) {
  require(bits == 8 || bits == 10, "a projector of {} bits", bits);
  const std::size_t last = levels() - 1;
  for (const ResponseCurve& curve : response.channels) {
    std::vector<float> light;
    for (std::size_t k = 0; k <= last; ++k) {
      light.push_back(static_cast<float>(curve(static_cast<double>(k) / static_cast<double>(last))));
      middle_.push_back(
          k < last ? static_cast<float>(curve((static_cast<double>(k) + 0.5) / static_cast<double>(last)))
                   : 2.0f);
    }
    std::size_t level = 0;
    for (int step = 0; step <= steps; ++step) {
      float root = static_cast<float>(step) / steps;
      while (level < last && light[level + 1] <= root * root) ++level;
      first_.push_back(static_cast<std::uint16_t>(level));
    }
    light_.insert(light_.end(), light.begin(), light.end());
    light_.push_back(2.0f);
  }
  if (dither == Dither::ordered) threshold_ = orderedThresholds(side);
  if (dither == Dither::blueNoise) threshold_ = blueNoise(side);
}

std::uint32_t DriveEncoder::level(std::size_t channel, float light, int x, int y) const noexcept {
  light = light > 0.0f ? std::min(light, 1.0f) : 0.0f;
  const std::size_t last = levels() - 1;
  const float* const lights = light_.data() + channel * (last + 2);
  auto step = static_cast<std::size_t>(std::sqrt(light) * static_cast<float>(steps));
  std::size_t k = first_[channel * (steps + 1) + step];
  while (lights[k + 1] <= light) ++k;
  if (k >= last) return static_cast<std::uint32_t>(last);
  float next =
      threshold_.empty()
          ? middle_[channel * (last + 1) + k]
          : lights[k] + threshold_[static_cast<std::size_t>(((y + ditherOffsets[channel][1]) % side) * side +
                                                            (x + ditherOffsets[channel][0]) % side)] *
                            (lights[k + 1] - lights[k]);
  return static_cast<std::uint32_t>(k + (light >= next ? 1 : 0));
}

}  // namespace relucent
