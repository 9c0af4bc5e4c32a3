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

image::Image brightness(const image::Image& picture, float gain, float most) {
  image::Image bright(picture.size(), 1);
  for (std::size_t i = 0; i < bright.data().size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
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

/// Of large views by pictures of fewer pixels: a camera is pushed back by hand, and who looks does not wait.
sentinels::Movement movementBetween(const image::Image& then, const image::Image& now) {
  const Size whole = then.size();
  const double larger = std::max(1.0, std::max(whole.width, whole.height) / longestSide);
  const auto side = [larger](int pixels) {
    return std::max(1, static_cast<int>(std::lround(pixels / larger)));
  };
  const Size few{side(whole.width), side(whole.height)};
  sentinels::Movement moved =
      sentinels::movementBetween({{image::resized(then, few), image::resized(now, few), {}}});
  moved.x *= static_cast<double>(whole.width) / few.width;
  moved.y *= static_cast<double>(whole.height) / few.height;
  return moved;
}

}  // namespace

AimOffset aimOffset(const image::Image& expected, const image::Image& seen, float saturation) {
  require(expected.size() == seen.size() && expected.channels() == 3 && seen.channels() == 3,
          "views of {}x{} and {}x{} pixels", expected.width(), expected.height(), seen.width(),
          seen.height());
  const image::Image now = brightness(seen, 1.0f, saturation);
  image::Image then = brightness(expected, 1.0f, std::numeric_limits<float>::infinity());
  AimOffset offset;
  if (!(sumOf(now) > 0.0) || !(sumOf(then) > 0.0)) return offset;  // nothing is seen
  float gain = 1.0f;
  for (int round = 0; round < rounds; ++round) {
    gain *= static_cast<float>(sumOf(now) / sumOf(then));
    then = brightness(expected, gain, saturation);
  }
  offset.movement = movementBetween(then, now);
  offset.gain = static_cast<double>(gain);
  offset.apart = relativeDifference(then, now);
  offset.isRecognised = offset.movement.explains || offset.apart < sentinels::reading_limit::view;
  return offset;
}

}  // namespace relucent::pipeline
