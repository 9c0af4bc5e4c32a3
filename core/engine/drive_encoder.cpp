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

void DriveEncoder::encodeLine(const float* light, int width, int y, std::uint32_t* words) const noexcept {
  const auto last = static_cast<std::uint32_t>(levels() - 1);
  std::fill(words, words + width, bits_ == 8 ? 0xff000000u : 0xc0000000u);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint16_t* const first = first_.data() + c * (steps + 1);
    const float* const lights = light_.data() + c * (last + 2);
    const float* const middles = middle_.data() + c * (last + 1);
    const float* const thresholds =
        threshold_.empty() ? nullptr : threshold_.data() + (y + ditherOffsets[c][1]) % side * side;
    const auto shift = static_cast<std::uint32_t>(bits_) * static_cast<std::uint32_t>(c);
    for (int x = 0; x < width; ++x) {
      float value = light[3 * static_cast<std::size_t>(x) + c];
      value = value > 0.0f ? value : 0.0f;
      value = value < 1.0f ? value : 1.0f;
      std::uint32_t k = first[static_cast<int>(std::sqrt(value) * static_cast<float>(steps))];
      while (lights[k + 1] <= value) ++k;
      const float next = thresholds == nullptr ? middles[k]
                                               : lights[k] + thresholds[(x + ditherOffsets[c][0]) % side] *
                                                                 (lights[k + 1] - lights[k]);
      k += static_cast<std::uint32_t>(value >= next) & static_cast<std::uint32_t>(k < last);
      words[x] |= k << shift;
    }
  }
}

}  // namespace relucent
