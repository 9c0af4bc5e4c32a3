// SPDX-License-Identifier: MIT
#include "relucent/engine/drive_encoder.h"

#include <algorithm>
#include <array>
#include <bit>

#include "relucent/base/error.h"
#include "relucent/engine/blue_noise.h"

namespace relucent::engine {
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

/// Light plus knee where a step begins.
float shiftedAt(std::size_t step) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(DriveEncoder::knee) +
                              (static_cast<std::uint32_t>(step) << DriveEncoder::shift));
}

}  // namespace

DriveEncoder::DriveEncoder(const linearization::ProjectorResponse& response, int bits, Dither dither)
    : bits_(bits) {
  require(bits == 8 || bits == 10, "a projector of {} bits", bits);
  const std::size_t last = levels() - 1;
  for (const hdr::ResponseCurve& curve : response.channels) {
    std::vector<float> light;
    for (std::size_t k = 0; k <= last; ++k) {
      light.push_back(static_cast<float>(curve(static_cast<double>(k) / static_cast<double>(last))));
      middle_.push_back(
          k < last ? static_cast<float>(curve((static_cast<double>(k) + 0.5) / static_cast<double>(last)))
                   : 2.0f);
    }
    // From just below a step's least light to just above its largest: rounding may put light into either.
    constexpr float below = 1.0f - 0x1p-23f, above = 1.0f + 0x1p-23f;
    std::size_t level = 0, reached = 0;
    for (std::size_t step = 0; step < steps; ++step) {
      const float least = shiftedAt(step) * below - knee, largest = shiftedAt(step + 1) * above - knee;
      while (level < last && light[level + 1] <= least) ++level;
      while (reached < last && light[reached + 1] <= largest) ++reached;
      mostPerStep_ = std::max(mostPerStep_, static_cast<int>(reached - level));
      first_.push_back(static_cast<std::uint16_t>(level));
    }
    light_.insert(light_.end(), light.begin(), light.end());
    light_.push_back(2.0f);
  }
  if (dither == Dither::ordered) threshold_ = orderedThresholds(side);
  static const std::vector<float> noise = blueNoise(side);  // the same for every projector
  if (dither == Dither::blueNoise) threshold_ = noise;
}

/// What encoding looks up for one channel of one line.
struct DriveEncoder::Channel {
  const std::uint16_t* first;
  const float *lights, *middles, *thresholds;
  std::size_t offset;  // of the thresholds

  Channel(const DriveEncoder& encoder, std::size_t c, int y)
      : first(encoder.first_.data() + c * steps),
        lights(encoder.light_.data() + c * (encoder.levels() + 1)),
        middles(encoder.middle_.data() + c * encoder.levels()),
        thresholds(encoder.threshold_.empty()
                       ? nullptr
                       : encoder.threshold_.data() + (y + ditherOffsets[c][1]) % side * side),
        offset(static_cast<std::size_t>(ditherOffsets[c][0])) {}

  /// Without a branch that depends on the light: they are what would take the time.
  template <bool dithered>
  std::uint32_t level(float value, std::uint32_t step, std::size_t x, std::uint32_t last,
                      int mostPerStep) const noexcept {
    std::uint32_t k = first[step];
    k += static_cast<std::uint32_t>(lights[k + 1] <= value);
    for (int i = 1; i < mostPerStep; ++i) k += static_cast<std::uint32_t>(lights[k + 1] <= value);
    const float next =
        dithered ? lights[k] + thresholds[(x + offset) % side] * (lights[k + 1] - lights[k]) : middles[k];
    return k + (static_cast<std::uint32_t>(value >= next) & static_cast<std::uint32_t>(k < last));
  }
};

namespace {

/// Some pixels' values between 0 and 1 and their steps in the tables, many at a time.
struct Steps {
  static constexpr std::size_t pixels = 64;
  std::array<float, 3 * pixels> light;
  std::array<std::uint32_t, 3 * pixels> step;

  void find(const float* from, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
      // In two steps, each of them one instruction; what is no number becomes 0.
      const float positive = from[i] > 0.0f ? from[i] : 0.0f;
      light[i] = positive < 1.0f ? positive : 1.0f;
    }
    for (std::size_t i = 0; i < count; ++i) step[i] = DriveEncoder::stepOf(light[i]);
  }
};

}  // namespace

template <bool dithered>
void DriveEncoder::encode(const float* light, std::size_t width, int y, std::uint32_t* words) const noexcept {
  const auto last = static_cast<std::uint32_t>(levels() - 1);
  const std::uint32_t opaque = bits_ == 8 ? 0xff000000u : 0xc0000000u;
  const Channel red(*this, 0, y), green(*this, 1, y), blue(*this, 2, y);
  const int bits = bits_, most = mostPerStep_;
  Steps found;
  for (std::size_t begin = 0; begin < width; begin += Steps::pixels) {
    const std::size_t count = std::min(Steps::pixels, width - begin);
    found.find(light + 3 * begin, 3 * count);
    for (std::size_t i = 0; i < count; ++i) {
      const float* value = &found.light[3 * i];
      const std::uint32_t* step = &found.step[3 * i];
      const std::size_t x = begin + i;
      words[x] = opaque | red.level<dithered>(value[0], step[0], x, last, most) |
                 green.level<dithered>(value[1], step[1], x, last, most) << bits |
                 blue.level<dithered>(value[2], step[2], x, last, most) << 2 * bits;
    }
  }
}

void DriveEncoder::encodeLine(const float* light, int width, int y, std::uint32_t* words) const noexcept {
  const auto count = static_cast<std::size_t>(width);
  if (threshold_.empty())
    encode<false>(light, count, y, words);
  else
    encode<true>(light, count, y, words);
}

}  // namespace relucent::engine
