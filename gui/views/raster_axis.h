// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <vector>

#include "relucent/base/raster.h"

namespace relucent::gui {

/// A side of T: pixels, numbered line by line and device by device.
struct RasterTick {
  double place = 0.0;  // pixel's number
  QString text;
};

/// Marks for the pixels [first, last): the numbers of lines ("240") while there are many of them, else pixels
/// ("312, 240"); about `count`. With several devices, the first mark of each but the first names the device.
std::vector<RasterTick> rasterTicks(const Rasters& rasters, double first, double last, int count);

/// "312, 240", for a second device "2: 312, 240".
QString pixelText(const Rasters& rasters, std::size_t index);

}  // namespace relucent::gui
