// SPDX-License-Identifier: MIT
#include "relucent/linearization/mosaic.h"

#include <algorithm>

namespace relucent::linearization {
namespace {

// Cells over the shorter side: large beside what a lens blurs, small beside the picture.
constexpr int cellsAcross = 12;

}  // namespace

Mosaic::Mosaic(Size projector, Random random, bool darkCells, std::size_t groups) : size_(projector) {
  side_ = std::max(1, std::min(size_.width, size_.height) / cellsAcross);
  across_ = (size_.width + side_ - 1) / side_;
  groupOfCell_.resize(static_cast<std::size_t>(across_ * ((size_.height + side_ - 1) / side_)));
  // Neighbours share out the groups, in random order: far light is then nearly the same for all of them.
  std::vector<std::size_t> order(darkCells ? 6 : groups);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i % groups;
  if (darkCells) order.push_back(mosaicGroups);
  for (std::size_t cell = 0; cell < groupOfCell_.size(); ++cell) {
    if (cell % order.size() == 0)
      for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    groupOfCell_[cell] = order[cell % order.size()];
  }
}

image::Image Mosaic::pattern(const MosaicDrive& drive) const {
  image::Image pattern(size_, 3);
  for (std::size_t i = 0; i < pattern.pixels(); ++i) {
    Pixel pixel = pixelAt(size_, i);
    std::size_t group = groupOfCell_[static_cast<std::size_t>(pixel.y / side_ * across_ + pixel.x / side_)];
    if (group == mosaicGroups) continue;
    for (std::size_t c = 0; c < 3; ++c) pattern.pixel(i)[c] = static_cast<float>(drive[3 * group + c]);
  }
  return pattern;
}

}  // namespace relucent::linearization
