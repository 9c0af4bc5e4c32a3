// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <span>

#include "relucent/image/colour_map.h"
#include "relucent/image/image.h"

namespace relucent::gui {

using image::ColourMap;

/// The values at the two ends of a colour map.
struct ColourScale {
  ColourMap map = ColourMap::cividis;
  double low = 0.0, high = 1.0;
  bool logarithmic = false;  // then both are above zero

  /// 0 to 1; NaN for values without a position, such as zero on a logarithmic scale.
  double place(double value) const;
};

QColor qtColourAt(ColourMap map, double place);

/// One value per pixel as colours; NaN gets the colour of invalid values.
/// Contract: values.size() == size.count().
QImage mapped(std::span<const float> values, Size size, const ColourScale& scale);

/// Linear light as seen by a viewer adapted to `white`.  Shape: three channels.
QImage pictureOf(const image::Image& linear, float white);
/// Encoded values, such as projector drive.
QImage encodedPictureOf(const image::Image& encoded);

}  // namespace relucent::gui
