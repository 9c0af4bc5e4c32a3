// SPDX-License-Identifier: MIT
#include "views/matrix_cells.h"

#include <algorithm>
#include <cmath>

namespace relucent::gui {
namespace {

constexpr int mostCells = 640;  // a side of what is seen: software draws it while it is moved

}  // namespace

std::size_t entriesOfACell(double entries, double pixels, int width) {
  double least = entries / std::clamp(pixels, 1.0, static_cast<double>(mostCells));
  auto cell = static_cast<std::size_t>(std::max(1.0, std::ceil(least - 1e-6)));
  auto line = static_cast<std::size_t>(width);
  return cell > 1 && 2 * cell >= line ? (cell + line / 2) / line * line : cell;
}

void fitCells(double first, double last, std::size_t all, std::size_t length, std::size_t& begin,
              std::size_t& end, int& cells) {
  length = std::min(length, all);
  if (last - first >= static_cast<double>(all)) {
    begin = 0, end = all, cells = static_cast<int>(all / length);
    return;
  }
  auto wanted = static_cast<std::size_t>(std::ceil((last - first) / static_cast<double>(length))) + 1;
  std::size_t count = std::clamp(wanted, std::size_t{1}, all / length);
  auto from = static_cast<std::size_t>(std::max(0.0, first)) / length * length;
  begin = std::min(from, all - count * length);
  end = begin + count * length;
  cells = static_cast<int>(count);
}

}  // namespace relucent::gui
