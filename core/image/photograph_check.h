// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "relucent/image/image.h"

namespace relucent::image {

/// A rectangle of pixels.
struct Region {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Region&) const = default;
};

/// Usability of a pixel of a photograph.
enum class Exposed : std::uint8_t { well, tooBright, tooDark };

/// Statistics of a photograph for setting up a camera.
struct PhotographCheck {
  static constexpr std::size_t bins = 128;
  std::array<std::array<std::uint32_t, bins>, 3> histogram{};  // per channel, equal bins over [0, 1]
  std::vector<Exposed> exposed;  // per pixel: any channel too bright; all channels too dark
  double tooBright = 0.0;        // shares of the pixels
  double tooDark = 0.0;
};

/// `saturation`, `dark`: limits at or above and below which a signal is unusable. NaN counts as too dark and
/// is in no bin.  Shape: three channels, full scale 1.
PhotographCheck checkPhotograph(const Image& signal, double saturation, double dark);

/// Share of the region's pixels that are too bright; of the part of it that lies in the photograph, 0 where
/// none does.  Shape: `size` is the photograph's.
double tooBrightWithin(const PhotographCheck& check, Size size, const Region& region);

/// Sharpness of a region: the mean squared difference of its brightness between neighbours, over its mean
/// squared brightness. Dimensionless, and independent of the exposure of an unsaturated photograph;
/// comparable only within one view. 0 for a region of less than two pixels or without light.
///   F = mean |grad L|^2 / mean L^2,   L = luminance
/// Source: Tenengrad family of focus measures; Pertuz, Puig & Garcia 2013.
double sharpness(const Image& signal, const Region& region);

/// Where a photograph is sharp: 1 where the brightness of neighbours differs by a share of their own,
///   |grad L| > limit * L,   L = luminance
/// and neither is too dark to tell. One value a pixel.
std::vector<std::uint8_t> focusPeaks(const Image& signal, double limit = 0.2, double dark = 0.02);

}  // namespace relucent::image
