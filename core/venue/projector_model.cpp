// SPDX-License-Identifier: MIT
#include "relucent/venue/projector_model.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::venue {
namespace {

/// Light that a white segment adds for the colourless part of a picture, relative to the other segments.
constexpr float whiteSegmentShare = 0.35f;

}  // namespace

ProjectorModel::ProjectorModel(const DeviceModelSettings& settings)
    : bits_(settings.projectorBits), gamma_(settings.gamma), whiteSegment_(settings.whiteSegment) {
  // Black is a little bluish: the filters hold back short waves least.
  float black = static_cast<float>(1.0 / settings.contrast);
  black_ = {0.9f * black, 0.95f * black, 1.15f * black};
  int codes = 1 << bits_;
  for (std::size_t channel = 0; channel < 3; ++channel)
    for (int code = 0; code < codes; ++code)
      lightOfCode_[channel].push_back(
          static_cast<float>(response(channel, static_cast<double>(code) / (codes - 1))));
}

double ProjectorModel::response(std::size_t channel, double drive) const {
  // A power law bent by an S: its toe and shoulder differ from channel to channel, as panels' do.
  constexpr std::array<double, 3> exponent = {0.95, 1.02, 1.08};
  constexpr std::array<double, 3> bend = {0.26, 0.18, 0.12};
  double power = std::pow(drive, gamma_ * exponent[channel]);
  double s = drive * drive * (3.0 - 2.0 * drive);
  return (1.0 - bend[channel]) * power + bend[channel] * s;
}

CameraStack ProjectorModel::light(const image::Image& encodedDrive) const {
  require(encodedDrive.channels() == 3, "a picture of {} channels for a projector of 3",
          encodedDrive.channels());
  CameraStack light(encodedDrive.data().size());
  float top = static_cast<float>((1 << bits_) - 1);
  std::size_t width = 3 * static_cast<std::size_t>(encodedDrive.width());
  parallelFor(0, static_cast<std::size_t>(encodedDrive.height()), 32, [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; i += 3) {
      for (std::size_t c = 0; c < 3; ++c) {
        float drive = encodedDrive.data()[i + c];
        // Written so that a NaN is black.
        float code = drive > 0.0f ? std::round(std::min(drive, 1.0f) * top) : 0.0f;
        light[i + c] = lightOfCode_[c][static_cast<std::size_t>(code)];
      }
      if (!whiteSegment_) continue;
      float white = whiteSegmentShare * std::min({light[i], light[i + 1], light[i + 2]});
      for (std::size_t c = 0; c < 3; ++c) light[i + c] = (light[i + c] + white) / (1.0f + whiteSegmentShare);
    }
  });
  return light;
}

}  // namespace relucent::venue
