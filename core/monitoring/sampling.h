// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/base/raster.h"

namespace relucent::monitoring {

struct SamplingSettings {
  std::size_t mostPixels = 9000;  // that are looked at: half of them evenly, half in patches
  int patch = 12;                 // side of a patch, pixels
  Size cells{16, 12};             // that the camera's view is divided into, at most
};

/// A square of neighbouring pixels, row by row: samples, as numbered by Sampling::pixels.
struct Patch {
  Size size;
  std::vector<std::uint32_t> samples;
};

/// Which pixels of one camera are looked at while a show plays: all of a small one, of a large one an even
/// grid of single pixels and patches of neighbours among them, so that a photograph costs as much whatever
/// the camera's size. Samples are numbered by ascending pixel.
struct Sampling {
  Size camera;
  std::vector<std::uint32_t> pixels;  // of the camera, a sample each
  std::vector<std::uint32_t> even;    // samples that stand for the view evenly: usable ones
  std::vector<std::uint16_t> cell;    // per sample
  Size cells;                         // of the view
  std::vector<Patch> patches;         // of usable samples mostly
};

/// `usable`: of that camera's pixels. Contract: as many as `camera` has.
Sampling sampledPixels(Size camera, const std::vector<std::uint8_t>& usable,
                       const SamplingSettings& settings = {});

}  // namespace relucent::monitoring
