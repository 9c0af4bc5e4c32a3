// SPDX-License-Identifier: MIT
#pragma once

#include <QPainter>

#include "views/colour_map.h"

namespace relucent {

/// Where a map's colours stand, upright, within an area at the side of a view; empty where that is too low.
QRectF colourBarIn(const QRectF& area);
void drawColourBar(QPainter& painter, const QRectF& area, const ColourScale& scale);
/// Its unit above it, its values beside it.
void drawColourBarWords(QPainter& painter, const QRectF& area, const ColourScale& scale, const QString& unit,
                        bool percent);

}  // namespace relucent
