// SPDX-License-Identifier: MIT
#include "relucent/linearization/test_light.h"

#include <algorithm>

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

}  // namespace relucent::linearization
