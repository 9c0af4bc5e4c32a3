// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace relucent::gui {

// The division of one side of T into cells, for a picture of a part of it.

/// Number of entries per cell, so that cells are about as large as the screen's pixels. From about a line of
/// the device's raster on, whole lines: these are faster to sum and cause no moire.
std::size_t entriesOfACell(double entries, double pixels, int width);

/// [first, last) extended to whole cells of equal length.
void fitCells(double first, double last, std::size_t all, std::size_t length, std::size_t& begin,
              std::size_t& end, int& cells);

}  // namespace relucent::gui
