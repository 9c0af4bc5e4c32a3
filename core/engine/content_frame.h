// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "relucent/base/raster.h"

namespace relucent::engine {

/// A picture in memory owned by the caller, top row first.
struct ContentFrame {
  enum class Format {
    rgb8,         // sRGB-encoded, 3 bytes a pixel
    rgba8,        // sRGB-encoded, 4 bytes a pixel, the fourth is ignored
    bgra8,        // the same with blue first
    linearFloat,  // linear light, 3 floats a pixel; clipped to [0, 1], NaN becomes 0
  };

  const void* data = nullptr;
  Size size;
  std::size_t bytesPerLine = 0;  // for linearFloat a multiple of 4
  Format format = Format::rgb8;
};

constexpr std::size_t bytesPerPixel(ContentFrame::Format format) {
  switch (format) {
    case ContentFrame::Format::rgb8:
      return 3;
    case ContentFrame::Format::rgba8:
    case ContentFrame::Format::bgra8:
      return 4;
    case ContentFrame::Format::linearFloat:
      break;
  }
  return 12;
}

}  // namespace relucent::engine
