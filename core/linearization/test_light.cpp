// SPDX-License-Identifier: MIT
#include "relucent/linearization/test_light.h"

#include <algorithm>

#include "relucent/base/random.h"

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

std::vector<image::Image> randomGreys(const rig::Rig& rig, std::uint64_t seed) {
  std::vector<image::Image> patterns;
  for (const auto& projector : rig.projectors) {
    const Size size = projector->size();
    const int side = std::max(1, std::min(size.width, size.height) / 12),
              across = (size.width + side - 1) / side;
    image::Image& pattern = patterns.emplace_back(size, 3);
    for (std::size_t i = 0; i < pattern.pixels(); ++i) {
      Pixel pixel = pixelAt(size, i);
      auto cell = static_cast<std::uint64_t>(pixel.y / side * across + pixel.x / side);
      std::ranges::fill(pattern.pixel(i), Random{seed, patterns.size(), cell}.uniformFloat());
    }
  }
  return patterns;
}

void showEven(rig::Rig& rig, Drive drive) {
  const std::vector<image::Image> patterns = evenPatterns(rig, drive);
  for (std::size_t i = 0; i < patterns.size(); ++i) rig.projectors[i]->show(patterns[i]);
}

}  // namespace relucent::linearization
