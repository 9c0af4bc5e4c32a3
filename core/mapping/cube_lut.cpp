// SPDX-License-Identifier: MIT
#include "relucent/mapping/cube_lut.h"

#include <fmt/format.h>

#include <vector>

#include "relucent/base/error.h"
#include "relucent/image/colour.h"

namespace relucent::mapping {

std::string cubeLut(const linearization::ProjectorResponse& response, const std::string& title, int side) {
  require(side >= 2, "a colour table of side {}", side);
  std::array<std::vector<double>, 3> drive;
  for (std::size_t c = 0; c < 3; ++c)
    for (int i = 0; i < side; ++i)
      drive[c].push_back(response.channels[c].inverse(
          image::srgbDecode(static_cast<double>(i) / static_cast<double>(side - 1))));
  std::string text = fmt::format("TITLE \"{}\"\nLUT_3D_SIZE {}\n", title, side);
  const auto count = static_cast<std::size_t>(side);
  for (std::size_t blue = 0; blue < count; ++blue)
    for (std::size_t green = 0; green < count; ++green)
      for (std::size_t red = 0; red < count; ++red)
        text += fmt::format("{:.6f} {:.6f} {:.6f}\n", drive[0][red], drive[1][green], drive[2][blue]);
  return text;
}

}  // namespace relucent::mapping
