// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "relucent/base/enum_names.h"

namespace relucent::compensation {

/// What becomes of a colour of which a place cannot show one channel.
enum class Clipping { channels, half, hue };
inline constexpr EnumName<Clipping> clippingNames[]{
    {Clipping::channels, "channels", "each channel for itself, as bright as can be; hues may shift"},
    {Clipping::half, "half", "the other channels dimmed by half as much as the one that clips"},
    {Clipping::hue, "hue", "all channels dimmed alike: hues stay, colours are darker"}};
constexpr EnumNames<Clipping> namesOf(Clipping) {
  return {"clipping", clippingNames};
}

/// How much of what the worst channel loses the others lose too: 0 to 1.
constexpr float sharedLoss(Clipping clipping) {
  return clipping == Clipping::channels ? 0.0f : clipping == Clipping::half ? 0.5f : 1.0f;
}

/// Light held between what a place shows at the least and at the most:
///   f = min_c most_c / light_c of the channels where light_c > most_c, at most 1;
///   clamp((1 - s (1 - f)) light, least, most),   s = sharedLoss(clipping)
/// By Clipping::hue the ratios of the channels stay wherever least does not lift one.
/// Contract: least <= most, least <= 0.
inline Eigen::Vector3f held(const Eigen::Vector3f& light, const Eigen::Vector3f& least,
                            const Eigen::Vector3f& most, Clipping clipping) {
  float scale = 1.0f;
  if (clipping != Clipping::channels) {
    float kept = 1.0f;
    for (int c = 0; c < 3; ++c)
      if (light[c] > most[c] && light[c] > 0.0f) kept = std::min(kept, std::max(0.0f, most[c]) / light[c]);
    scale -= sharedLoss(clipping) * (1.0f - kept);
  }
  return (scale * light).cwiseMin(most).cwiseMax(least);
}

}  // namespace relucent::compensation
