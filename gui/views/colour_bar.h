// SPDX-License-Identifier: MIT
#pragma once

#include <QPainter>

#include "views/colour_map.h"

namespace relucent {

/// A map's colours with their values and unit, upright, painted into an area at the side of a view.
void drawColourBar(QPainter& painter, const QRectF& area, const ColourScale& scale, const QString& unit,
                   bool percent);

}  // namespace relucent
