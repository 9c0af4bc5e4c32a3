// SPDX-License-Identifier: MIT
#include "relucent/acquisition/venue_change.h"

#include <algorithm>

namespace relucent::acquisition {

bool VenueChange::isOfLight() const {
  return scaled > 0.0 || std::ranges::any_of(light, [](const transport::ColourBlock& left) {
           return left != transport::ColourBlock::Ones();
         });
}

double flaggedShareOf(const CameraMask& flags, const CameraMask& among) {
  std::size_t set = 0, all = 0;
  for (std::size_t row = 0; row < flags.size(); ++row) {
    if (!among[row]) continue;
    ++all;
    set += flags[row] ? 1 : 0;
  }
  return all > 0 ? static_cast<double>(set) / static_cast<double>(all) : 0.0;
}

}  // namespace relucent::acquisition
