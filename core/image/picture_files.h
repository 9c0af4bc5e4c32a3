// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "image/image.h"

namespace relucent {

/// A picture as a file holds it: three channels R, G, B.
struct Picture {
  /// Whole numbers of the file divided by 2^bits - 1, so 0 to 1. Of a floating-point file (bits == 0): its
  /// values as they are, which by custom are linear light.
  Image encoded;
  int bits = 0;  // 8, 16; 0: floating point
};

/// How a picture that says that it was taken sideways is returned.
enum class Orientation {
  asStored,  // photographs for measuring: the sensor's rows, however the camera was tilted
  upright    // content: as people look at it
};

/// Reads PNG, TIFF, JPEG and whatever else OpenCV knows, with 8 or 16 bits or float, and OpenEXR (by the
/// file's first bytes, not its name). Grey is replicated; transparent pictures are laid on black, which is no
/// light. Throws: Error{disk} if unreadable; Error{format} if not a picture, cut short, or of unusual
/// samples.
Picture readPicture(const std::filesystem::path& path, Orientation orientation = Orientation::asStored);

/// Content to be shown, as linear light, upright: whole-number files are decoded as sRGB to 0..1,
/// floating-point ones taken as linear. Negative values (colours outside the gamut) become 0; values above 1
/// stay. Throws: as readPicture(); Error{input} for NaN and infinities.
Image readLinearContent(const std::filesystem::path& path);

/// The bytes of a PNG of an image of 1 or 3 channels, clamped to [0, 1] and rounded to the nearest of
/// 2^bits - 1 steps. No colour transform: what is encoded stays so.
/// Throws: std::logic_error unless bits is 8 or 16 and every value is a number.
std::string encodePng(const Image& encoded, int bits);

/// Writes encodePng() atomically. Throws: Error{disk}.
void writePng(const std::filesystem::path& path, const Image& encoded, int bits);

}  // namespace relucent
