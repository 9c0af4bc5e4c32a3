// SPDX-License-Identifier: MIT
#include "relucent/linearization/test_light.h"

#include <algorithm>
#include <cmath>

namespace relucent::linearization {

std::vector<image::Image> evenPatterns(const rig::Rig& rig, Drive drive) {
  std::vector<image::Image> patterns;
  for (const auto& projector : rig.projectors) {
    image::Image& pattern = patterns.emplace_back(projector->size(), 3);
    for (std::size_t i = 0; i < pattern.pixels(); ++i)
      std::copy(drive.begin(), drive.end(), pattern.pixel(i).begin());
  }
  return patterns;
}

std::vector<image::Image> evenPatterns(const rig::Rig& rig, std::size_t projector, Drive drive) {
  std::vector<image::Image> patterns = evenPatterns(rig, drive);
  for (std::size_t other = 0; other < patterns.size(); ++other)
    if (other != projector) patterns[other] = image::Image(patterns[other].size(), 3);
  return patterns;
}

void showEven(rig::Rig& rig, Drive drive) {
  const std::vector<image::Image> patterns = evenPatterns(rig, drive);
  for (std::size_t i = 0; i < patterns.size(); ++i) rig.projectors[i]->show(patterns[i]);
}

LightMeter::LightMeter(rig::ShotTaker& shots, std::vector<hdr::CameraModel> cameras,
                       std::vector<double> exposures)
    : shots_(shots),
      cameras_(std::move(cameras)),
      exposures_(std::move(exposures)),
      rasters_(shots.rig().cameraRasters()) {}

hdr::HdrFrame LightMeter::measure(const std::vector<image::Image>& encodedPatterns,
                                  const Progress& progress) const {
  return hdr::mergeBracket(shots_.take(encodedPatterns, exposures_, progress), cameras_, rasters_);
}

LightWeights::LightWeights(const hdr::HdrFrame& lit, const hdr::HdrFrame& black) {
  std::vector<float> difference(lit.radiance.size());
  for (std::size_t at = 0; at < difference.size(); ++at)
    difference[at] = lit.radiance[at] - black.radiance[at];
  std::vector<float> sorted = difference;
  auto high = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 99 / 100);
  std::nth_element(sorted.begin(), high, sorted.end());
  double limit = 0.1 * static_cast<double>(*high);

  for (std::size_t at = 0; at < difference.size(); ++at) {
    double light = difference[at], variance = static_cast<double>(lit.variance[at] + black.variance[at]);
    bool stands = light > limit && light > 5.0 * std::sqrt(variance);
    if (stands && lit.valid[at] != 0 && black.valid[at] != 0) terms_.push_back({at, light / variance});
  }
}

double LightWeights::of(const hdr::HdrFrame& frame) const {
  double sum = 0.0;
  for (const Term& term : terms_) sum += term.weight * static_cast<double>(frame.radiance[term.at]);
  return sum;
}

double LightWeights::varianceOf(const hdr::HdrFrame& frame) const {
  double sum = 0.0;
  for (const Term& term : terms_)
    sum += term.weight * term.weight * static_cast<double>(frame.variance[term.at]);
  return sum;
}

}  // namespace relucent::linearization
