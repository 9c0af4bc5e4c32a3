// SPDX-License-Identifier: MIT
#pragma once

#include <QPainter>

#include "views/colour_map.h"

namespace relucent::gui {

/// The rectangle of a vertical colour bar within an area at the side of a view; empty if that is too low.
QRectF colourBarIn(const QRectF& area);
void drawColourBar(QPainter& painter, const QRectF& area, const ColourScale& scale);
/// Draws the unit above it and the values beside it.
void drawColourBarWords(QPainter& painter, const QRectF& area, const ColourScale& scale, const QString& unit,
                        bool percent);

}  // namespace relucent::gui
