// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "relucent/base/random.h"
#include "relucent/image/image.h"

namespace relucent::linearization {

/// Into how many groups the cells of a mosaic fall at most.
inline constexpr std::size_t mosaicGroups = 3;
/// Into how many they do of each of several projectors. A photograph tells 3 * groups levels of each, once
/// its 3 * groups lights have been photographed alone; for the usual number of levels three groups need the
/// fewest photographs of one projector or two, two groups of more.
constexpr std::size_t mosaicGroupsOf(std::size_t projectors) {
  return projectors > 2 ? 2 : mosaicGroups;
}
/// A light of a mosaic is one group's cells in one channel: light 3 * group + channel. Those of groups that
/// there are not are always dark.
inline constexpr std::size_t mosaicLights = 3 * mosaicGroups;
/// Encoded drive of every light.
using MosaicDrive = std::array<double, mosaicLights>;

/// A projector's picture divided into square cells, each of a random group. Every group is spread evenly over
/// the picture, so that cameras see all groups wherever they look.
class Mosaic {
 public:
  /// `darkCells`, for several projectors at once: every seventh cell is of no group. Without them, two
  /// projectors with the same picture in the same place could exchange light that all their groups share, and
  /// no camera would see it.
  Mosaic(Size projector, Random random, bool darkCells, std::size_t groups = mosaicGroups);

  /// Every cell in the colour of its group, black if it has none.
  image::Image pattern(const MosaicDrive& drive) const;

 private:
  Size size_;
  int side_ = 1, across_ = 1;
  std::vector<std::size_t> groupOfCell_;  // mosaicGroups: none
};

}  // namespace relucent::linearization
