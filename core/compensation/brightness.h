// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "relucent/base/enum_names.h"

namespace relucent::compensation {

/// How bright white is where.
enum class Brightness { even, picture, region };
inline constexpr EnumName<Brightness> brightnessNames[]{
    {Brightness::even, "even", "one white for whatever is shown, as bright as the venue lets most pixels be"},
    {Brightness::picture, "picture", "one white for each picture, at which the least of it is lost"},
    {Brightness::region, "region", "the same for each part of the picture, smoothly from one to the next"}};
constexpr EnumNames<Brightness> namesOf(Brightness) {
  return {"brightness", brightnessNames};
}

/// Gains of white over the content, whose corners are (0, 0) and (1, 1): bilinear between the centres of
/// cells, in powers of two.
struct BrightnessField {
  static constexpr std::size_t columns = 16, rows = 12;
  std::array<float, columns * rows> octaves{};

  float octavesAt(float u, float v) const;
  float gain(float u, float v) const;
  bool operator==(const BrightnessField&) const = default;
};

/// A pixel that the content covers: where, its colour as the venue mixes it, and what it can show there,
/// relative to the white whose gain is looked for.
struct BrightnessSample {
  float u = 0.0f, v = 0.0f;
  std::array<float, 3> wanted{}, least{}, most{};
  float weight = 1.0f;
};

/// The gains at which the venue's limits take the least from what is seen. With what is left of a pixel,
///   s(g) = clamp(g wanted, least, most) / g,
///   E(g) = sum w (sum_c |f(s_c) - f(wanted_c)|^2 + prior (log2 g)^2),   f: sRGB's scale,
/// region: w = weight times a Gaussian of the distance, and log2 g less that of the whole picture; the minima
/// are smoothed over the picture by a narrower Gaussian. g lies between 2^-1/2 and 4. The same gain for all
/// channels: hues stay.  Without samples: 1.  Source: core/compensation/README.md.
class BrightnessFit {
 public:
  /// `aspect`: width / height of the content as it is seen.
  BrightnessFit(Brightness way, double aspect);
  /// Allocates nothing.
  BrightnessField fit(std::span<const BrightnessSample> samples) const;

 private:
  Brightness way_;
  // Between centres of cells, one axis after the other: [distance].
  std::array<float, BrightnessField::columns> across_{}, acrossNarrow_{};
  std::array<float, BrightnessField::rows> down_{}, downNarrow_{};
  std::vector<float> scale_;  // f of equal steps of light
};

}  // namespace relucent::compensation
