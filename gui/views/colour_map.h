// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <span>

#include "image/image.h"

namespace relucent {

/// Errors and differences: cividis. Transport and reachable light: viridis.
enum class ColourMap { cividis, viridis };

/// The values that the two ends of a colour map stand for.
struct ColourScale {
  ColourMap map = ColourMap::cividis;
  double low = 0.0, high = 1.0;
  bool logarithmic = false;  // then both are above zero

  /// 0 to 1; NaN for what has no place, as zero on a logarithmic scale.
  double place(double value) const;
};

QColor colourAt(ColourMap map, double place);

/// One value a pixel as colours; what is no number gets the colour of what is invalid.
/// Contract: values.size() == size.count().
QImage mapped(std::span<const float> values, Size size, const ColourScale& scale);

/// Linear light as somebody sees it who is used to `white`.  Shape: three channels.
QImage pictureOf(const Image& linear, float white);
/// Values that are encoded already, as a projector is given them.
QImage encodedPictureOf(const Image& encoded);

}  // namespace relucent
