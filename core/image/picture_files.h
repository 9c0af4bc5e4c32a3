// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "relucent/image/image.h"

namespace relucent::image {

/// A picture as stored in a file: three channels R, G, B.
struct Picture {
  /// Integers of the file divided by 2^bits - 1, so 0 to 1. For a floating-point file (bits == 0) its values
  /// unchanged, by convention linear light.
  Image encoded;
  int bits = 0;  // 8, 16; 0: floating point
};

/// How the orientation tag of a picture is handled.
enum class Orientation {
  asStored,  // ignored, for measuring: the sensor's rows
  upright    // applied, for content
};

/// Reads PNG, TIFF, JPEG and all other formats of OpenCV, with 8 or 16 bits or float, and OpenEXR (by the
/// file's first bytes, not its name). Grey is replicated; transparent pictures are composited on black.
/// Throws: Error{disk} if unreadable; Error{format} if not a picture, truncated, or with unsupported samples.
Picture readPicture(const std::filesystem::path& path, Orientation orientation = Orientation::asStored);

/// Content to be shown, as linear light, upright: integer files are decoded as sRGB to 0..1, floating-point
/// ones taken as linear. Negative values (colours outside the gamut) become 0; values above 1 are kept.
/// Throws: as readPicture(); Error{input} for NaN and infinities.
Image readLinearContent(const std::filesystem::path& path);

/// The bytes of a PNG of an image of 1 or 3 channels, clamped to [0, 1] and rounded to the nearest of 2^bits
/// - 1 steps. No colour transform.
/// Throws: std::logic_error unless bits is 8 or 16 and no value is NaN.
std::string encodePng(const Image& encoded, int bits);

/// The bytes of a JPEG, likewise, of 8 bits, at the quality that is usual for its library.
/// Throws: std::logic_error as encodePng().
std::string encodeJpeg(const Image& encoded);

/// Writes encodePng() atomically. Throws: Error{disk}.
void writePng(const std::filesystem::path& path, const Image& encoded, int bits);

}  // namespace relucent::image
