// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "relucent/base/raster.h"
#include "relucent/image/image.h"

namespace relucent::test {

/// A raw file as small as can be: an uncompressed DNG of 16-bit codes. LibRaw wants at least 22x22 of them.
struct Dng {
  Size size{24, 22};
  std::array<std::uint8_t, 4> filter{0, 1, 1, 2};  // of a 2x2 cell: 0 red, 1 green, 2 blue
  std::array<std::uint16_t, 4> black{};            // of the same places
  std::uint16_t white = 65535;
  double seconds = 0.0;                // 0: not written
  std::string taken{};                 // "2026:11:21 19:30:05"; empty: not written
  bool isLinear = false;               // three interpolated colours instead of a filter
  std::vector<std::uint16_t> codes{};  // row by row; of a linear one red, green, blue in turn
};
std::string bytesOf(const Dng& dng);

/// The raw file of a photograph: every pixel becomes a 2x2 cell red, green, green, blue, with black at 512
/// and white at 15871.
Dng dngOf(const image::Image& signal);

}  // namespace relucent::test
