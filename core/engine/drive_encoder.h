// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "relucent/linearization/linearization.h"

namespace relucent::engine {

enum class Dither {
  none,       // nearest drive level
  ordered,    // Bayer's 8x8 thresholds
  blueNoise,  // thresholds without low frequencies
};

/// Turns linear light into a projector's drive levels by look-up. With dither the mean light over a few
/// pixels is the wanted one, not the mean drive:
///   level = k + [light >= light(k) + threshold (light(k + 1) - light(k))],   light(k) <= light < light(k +
///   1)
/// One 32-bit word a pixel, red lowest: 8 bits a channel and 255 (GL_RGBA8), or 10 bits and 3 (GL_RGB10_A2).
class DriveEncoder {
 public:
  // Steps of the tables: the upper bits of light + knee as a float, finer in the dark as levels are.
  static constexpr float knee = 0x1p-6f;
  static constexpr int shift = 13;
  static constexpr std::uint32_t stepOf(float light) {
    return (std::bit_cast<std::uint32_t>(light + knee) - std::bit_cast<std::uint32_t>(knee)) >> shift;
  }
  static constexpr std::size_t steps =
      ((std::bit_cast<std::uint32_t>(1.0f + knee) - std::bit_cast<std::uint32_t>(knee)) >> shift) + 1;
  static constexpr int side = 64;  // of the thresholds

  DriveEncoder() = default;
  /// Contract: bits is 8 or 10.
  DriveEncoder(const linearization::ProjectorResponse& response, int bits, Dither dither);

  int bits() const { return bits_; }
  /// [channel][step]: a level whose light is at most that at the step; `steps` a channel.
  std::span<const std::uint16_t> firstLevels() const { return first_; }
  /// Largest number of levels between two steps.
  int mostPerStep() const { return mostPerStep_; }
  /// [channel][level]: its light; levels + 1 a channel, the last one beyond every light.
  std::span<const float> lights() const { return light_; }
  /// [channel][level]: the light above which the next level is nearer in drive. Without dither only.
  std::span<const float> middles() const { return middle_; }
  /// side x side; empty without dither.
  std::span<const float> thresholds() const { return threshold_; }
  std::size_t levels() const { return std::size_t{1} << bits_; }

  /// The words for line y of linear light, 3 values a pixel; NaN is black.
  void encodeLine(const float* light, int width, int y, std::uint32_t* words) const noexcept;

 private:
  struct Channel;
  template <bool dithered>
  void encode(const float* light, std::size_t width, int y, std::uint32_t* words) const noexcept;

  int bits_ = 8;
  int mostPerStep_ = 1;
  std::vector<std::uint16_t> first_;
  std::vector<float> light_, middle_, threshold_;
};

/// Offset of a channel in the thresholds: as far as possible from the others, so that the channels' patterns
/// do not coincide.
inline constexpr std::array<std::array<int, 2>, 3> ditherOffsets{{{0, 0}, {21, 43}, {43, 21}}};

}  // namespace relucent::engine
