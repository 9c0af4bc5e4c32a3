// SPDX-License-Identifier: MIT
#include "relucent/pipeline/aim.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/require.h"
#include "relucent/sentinels/observer.h"

namespace relucent::pipeline {
namespace {

constexpr int rounds = 3;  // of finding the gain: what saturates shares in the mean

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
  offset.movement = sentinels::movementBetween(then, now);
  offset.apart = relativeDifference(then, now);
  offset.isRecognised = offset.movement.explains || offset.apart < sentinels::reading_limit::view;
  return offset;
}

}  // namespace relucent::pipeline
