// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace relucent {

// How T is cut into cells for a picture of a part of it, along one of its sides.

/// How many entries make a cell, so that cells are about as large as the screen's pixels. From about a line
/// of the device's picture on, whole lines: they are quicker to sum, and no pattern of their own is seen.
std::size_t entriesOfACell(double entries, double pixels, int width);

/// [first, last) widened to whole cells of equal length; all of it in cells of about that length.
void fitCells(double first, double last, std::size_t all, std::size_t length, std::size_t& begin,
              std::size_t& end, int& cells);

}  // namespace relucent
