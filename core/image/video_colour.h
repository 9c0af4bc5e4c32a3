// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "relucent/base/raster.h"

namespace relucent::image {

/// Encoding of a video. Primaries are assumed to be those of BT.709; those of BT.601 differ from them by less
/// than projectors differ from either.
struct VideoEncoding {
  enum class Matrix { bt601, bt709 };
  enum class Range {
    video,  // luma 16 to 235, chroma 16 to 240
    full,   // 0 to 255
  };
  enum class Transfer {
    bt1886,  // light = v^2.4: the reference display for grading
    srgb,
    linear,
    gamma22,
    gamma28,
  };
  Matrix matrix = Matrix::bt709;
  Range range = Range::video;
  Transfer transfer = Transfer::bt1886;
};

/// Luma and chroma of a frame in memory owned by the caller, top row first. Chroma may be coarser; the last
/// column and row of an odd size have chroma of their own.
struct VideoSamples {
  struct Plane {
    const void* data = nullptr;
    std::size_t bytesPerLine = 0;
    int step = 1;  // samples from one pixel to the next
  };
  Plane luma, blue, red;           // Y, Cb, Cr; without data for the chroma: grey
  int bits = 8;                    // of a sample; above 8 bits two bytes, low byte first
  int coarserX = 1, coarserY = 1;  // pixels that share a chroma sample
};

/// The light of a video frame as sRGB codes, 4 bytes a pixel, the fourth 255:
///   y = (Y - 16) / 219, b = (Cb - 128) / 224, r = (Cr - 128) / 224   (full range: Y / 255, (C - 128) / 255)
///   R = y + 2 (1 - k_r) r,  B = y + 2 (1 - k_b) b,  G = (y - k_r R - k_b B) / (1 - k_r - k_b)
///   code = 255 srgbEncode(transfer(clamp01(R, G, B)))
/// with k_r, k_b = 0.299, 0.114 (BT.601) or 0.2126, 0.0722 (BT.709). For samples of n bits these constants
/// are scaled by 2^(n - 8). Source: ITU-R BT.601-7, BT.709-6, BT.1886, BT.2100. Contract: 8 <= bits <= 16,
/// coarser >= 1.
void srgbFromVideo(const VideoSamples& samples, Size size, const VideoEncoding& encoding, std::uint8_t* rgbx,
                   std::size_t bytesPerLine);

}  // namespace relucent::image
