// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "relucent/base/raster.h"

namespace relucent::engine {

/// Pixels of one camera: [from, to).
struct CameraRectangle {
  std::size_t camera;
  Pixel from, to;
};

}  // namespace relucent::engine
