// SPDX-License-Identifier: MIT
#include "relucent/pipeline/aim.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/require.h"
#include "relucent/image/resample.h"
#include "relucent/sentinels/observer.h"

namespace relucent::pipeline {
namespace {

constexpr double longestSide = 640.0;  // pixels, of which a hundredth is found
constexpr int rounds = 3;              // of finding the gain: what saturates shares in the mean

double sumOf(const image::Image& picture) {
  double sum = 0.0;
  for (float value : picture.data()) sum += static_cast<double>(value);
  return sum;
}

using Mask = std::vector<std::uint8_t>;

/// 0 where nothing is compared.
image::Image brightness(const image::Image& picture, float gain, float most, const Mask& compared) {
  image::Image bright(picture.size(), 1);
  for (std::size_t i = 0; i < bright.data().size(); ++i)
    for (std::size_t c = 0; c < 3 && (compared.empty() || compared[i] != 0); ++c)
      bright.data()[i] += std::clamp(gain * picture.data()[3 * i + c], 0.0f, most);
  return bright;
}

double relativeDifference(const image::Image& a, const image::Image& b) {
  double apart = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < a.data().size(); ++i) {
    const auto from = static_cast<double>(a.data()[i]), to = static_cast<double>(b.data()[i]);
    apart += (to - from) * (to - from);
    whole += from * from;
  }
  return whole > 0.0 ? std::sqrt(apart / whole) : 0.0;
}

/// Pixels that come from such pixels alone.
Mask resized(const Mask& mask, const Size& from, const Size& to) {
  if (mask.empty() || from == to) return mask;
  image::Image picture(from, 1);
  for (std::size_t i = 0; i < mask.size(); ++i) picture.data()[i] = mask[i] != 0 ? 1.0f : 0.0f;
  constexpr float all = 0.999f;
  const image::Image shares = image::resized(picture, to);
  Mask smaller;
  for (float share : shares.data()) smaller.push_back(share > all ? 1 : 0);
  return smaller;
}

/// Of large views by pictures of fewer pixels: a camera is pushed back by hand, and who looks does not wait.
sentinels::Movement movementBetween(const image::Image& then, const image::Image& now, const Mask& compared) {
  const Size whole = then.size();
  const double larger = std::max(1.0, std::max(whole.width, whole.height) / longestSide);
  const auto side = [larger](int pixels) {
    return std::max(1, static_cast<int>(std::lround(pixels / larger)));
  };
  const Size few{side(whole.width), side(whole.height)};
  sentinels::Movement moved = sentinels::movementBetween(
      {{image::resized(then, few), image::resized(now, few), resized(compared, whole, few)}});
  moved.x *= static_cast<double>(whole.width) / few.width;
  moved.y *= static_cast<double>(whole.height) / few.height;
  return moved;
}

}  // namespace

Mask comparedPixels(const CameraMask& usable, const hdr::HdrFrame& seen, const Rasters& cameras,
                    std::size_t camera) {
  Mask compared(cameras.size(camera).count());
  for (std::size_t i = 0; i < compared.size(); ++i) {
    const std::size_t row = cameras.offset(camera) + i;
    const bool isKnown = seen.valid[3 * row] && seen.valid[3 * row + 1] && seen.valid[3 * row + 2];
    compared[i] = usable[row] != 0 && isKnown ? 1 : 0;
  }
  return compared;
}

AimOffset aimOffset(const image::Image& expected, const image::Image& seen, float saturation,
                    const Mask& compared) {
  require(expected.size() == seen.size() && expected.channels() == 3 && seen.channels() == 3,
          "views of {}x{} and {}x{} pixels", expected.width(), expected.height(), seen.width(),
          seen.height());
  require(compared.empty() || compared.size() == expected.size().count(), "{} pixels compared of {}",
          compared.size(), expected.size().count());
  const image::Image now = brightness(seen, 1.0f, saturation, compared);
  image::Image then = brightness(expected, 1.0f, std::numeric_limits<float>::infinity(), compared);
  AimOffset offset;
  if (!(sumOf(now) > 0.0) || !(sumOf(then) > 0.0)) return offset;  // nothing is seen
  float gain = 1.0f;
  for (int round = 0; round < rounds; ++round) {
    gain *= static_cast<float>(sumOf(now) / sumOf(then));
    then = brightness(expected, gain, saturation, compared);
  }
  offset.movement = movementBetween(then, now, compared);
  offset.gain = static_cast<double>(gain);
  offset.apart = relativeDifference(then, now);
  offset.isRecognised = offset.movement.explains || offset.apart < sentinels::reading_limit::view;
  return offset;
}

}  // namespace relucent::pipeline
