// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "relucent/image/image.h"

namespace relucent::image {

/// Three values of a colour; the name of the variable states the colour space.
using Colour = std::array<double, 3>;

/// The sRGB transfer function, exact and piecewise; an odd function, so that negative values are preserved.
/// Source: IEC 61966-2-1.
double srgbEncode(double linear);
double srgbDecode(double encoded);
Image srgbEncoded(const Image& linear);
Image srgbDecoded(const Image& encoded);

/// Y = 0.2126 R + 0.7152 G + 0.0722 B, of linear values.  Source: ITU-R BT.709.
double luminance(const Colour& linearRgb);
inline constexpr std::array<float, 3> luminanceWeights{0.2126f, 0.7152f, 0.0722f};
inline float luminanceOf(float red, float green, float blue) {
  return luminanceWeights[0] * red + luminanceWeights[1] * green + luminanceWeights[2] * blue;
}
/// The same for every pixel of an image of three channels: one channel.
Image luminance(const Image& linear);

/// Linear sRGB -> CIE XYZ, white at Y = 1 (D65).  Source: IEC 61966-2-1.
Colour xyzFromLinearRgb(const Colour& linearRgb);
/// CIE XYZ -> CIE L*a*b* with the white of sRGB, so that grey is a = b = 0.  Source: CIE 15.
Colour labFromXyz(const Colour& xyz);

/// The colour difference CIEDE2000 with kL = kC = kH = 1.  Source: Sharma, Wu & Dalal 2005.
double ciede2000(const Colour& lab1, const Colour& lab2);

/// What a viewer adapted to `white` sees, as sRGB: encode(clamp(linear / white, 0, 1)) per channel.
/// Used by meanDeltaE() and ssim().
Image viewed(const Image& linear, const std::array<float, 3>& white);

/// Mean CIEDE2000 between two sRGB-encoded images over the pixels where `mask` is not 0 (empty: all).
/// Throws: std::logic_error if shapes differ or no pixel is left.
double meanDeltaE(const Image& encodedA, const Image& encodedB, std::span<const std::uint8_t> mask = {});

/// CIEDE2000 between two sRGB-encoded images over the pixels where `mask` is not 0 (empty: all): the mean,
/// and the value that 95 % of the pixels do not exceed.  Throws: as meanDeltaE().
struct ColourDifference {
  double mean = 0.0;
  double percentile95 = 0.0;
};
ColourDifference colourDifference(const Image& encodedA, const Image& encodedB,
                                  std::span<const std::uint8_t> mask = {});

/// CIEDE2000 of every pixel of two sRGB-encoded images: one channel, NaN where `mask` is 0.
/// Throws: std::logic_error if shapes differ.
Image deltaEMap(const Image& encodedA, const Image& encodedB, std::span<const std::uint8_t> mask = {});

}  // namespace relucent::image
