// SPDX-License-Identifier: MIT
#include "relucent/mapping/pfm.h"

#include <fmt/format.h>

#include <bit>

#include "relucent/base/error.h"

namespace relucent::mapping {

static_assert(std::endian::native == std::endian::little, "PFM is written as it lies in memory");

std::string encodePfm(const image::Image& image) {
  require(image.channels() == 3, "a portable float map of {} channels", image.channels());
  std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", image.width(), image.height());
  const std::size_t line = 3 * static_cast<std::size_t>(image.width());
  for (int y = image.height() - 1; y >= 0; --y)
    bytes.append(reinterpret_cast<const char*>(image.data().data() + static_cast<std::size_t>(y) * line),
                 line * sizeof(float));
  return bytes;
}

}  // namespace relucent::mapping
