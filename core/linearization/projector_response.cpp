// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/linearization/linearization.h"

namespace relucent::linearization {
namespace {

constexpr std::size_t tableSteps = 4096;

/// Drive over the square root of light, where display curves are close to straight. Linear in between; as
/// curve and table ascend together, the light is never further off than one step: 2 sqrt(L) / tableSteps.
std::vector<float> driveTable(const hdr::ResponseCurve& curve) {
  std::vector<float> table(tableSteps + 2);
  for (std::size_t i = 0; i <= tableSteps; ++i) {
    double root = static_cast<double>(i) / tableSteps;
    table[i] = static_cast<float>(curve.inverse(root * root));
  }
  table[tableSteps + 1] = table[tableSteps];
  return table;
}

template <typename Function>
image::Image mapped(const image::Image& image, const Function& function) {
  require(image.channels() == 3, "an image of {} channels where 3 are needed", image.channels());
  image::Image result(image.size(), 3);
  parallelFor(0, image.pixels(), 1024, [&](std::size_t pixel) {
    for (std::size_t c = 0; c < 3; ++c)
      result.pixel(pixel)[c] = function(c, std::clamp(image.pixel(pixel)[c], 0.0f, 1.0f));
  });
  return result;
}

}  // namespace

image::Image ProjectorResponse::encode(const image::Image& linear) const {
  if (linear.pixels() <= tableSteps)
    return mapped(linear, [&](std::size_t c, float value) {
      return static_cast<float>(channels[c].inverse(static_cast<double>(value)));
    });
  std::array<std::vector<float>, 3> tables;
  for (std::size_t c = 0; c < 3; ++c) tables[c] = driveTable(channels[c]);
  return mapped(linear, [&](std::size_t c, float value) {
    float place = std::sqrt(value) * static_cast<float>(tableSteps);
    auto step = static_cast<std::size_t>(place);
    float share = place - static_cast<float>(step);
    return tables[c][step] + share * (tables[c][step + 1] - tables[c][step]);
  });
}

image::Image ProjectorResponse::decode(const image::Image& encoded) const {
  return mapped(encoded, [&](std::size_t c, float value) {
    return static_cast<float>(channels[c](static_cast<double>(value)));
  });
}

}  // namespace relucent::linearization
