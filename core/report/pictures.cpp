// SPDX-License-Identifier: MIT
#include "relucent/report/pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/image/colour.h"
#include "relucent/image/picture_files.h"

namespace relucent::report {
image::Image deltaEMap(const image::Image& a, const image::Image& b, const std::array<float, 3>& white,
                       const CameraMask& inside) {
  require(a.size() == b.size() && a.channels() == 3 && b.channels() == 3, "images of one size are compared");
  return deltaEMap(image::viewed(a, white), image::viewed(b, white), inside);
}

image::Image reachableLight(const image::Image& flood, const image::Image& black,
                            const std::array<float, 3>& white) {
  image::Image result(flood.size(), 1);
  for (std::size_t pixel = 0; pixel < flood.pixels(); ++pixel) {
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t c = 0; c < 3; ++c) {
      float below = black.empty() ? 0.0f : black.pixel(pixel)[c];
      least = std::min(least, (flood.pixel(pixel)[c] + below) / white[c]);
    }
    result.data()[pixel] = std::max(least, 0.0f);
  }
  return result;
}

std::array<float, 3> percentileWhite(const image::Image& linear, double share) {
  std::array<float, 3> white{1.0f, 1.0f, 1.0f};
  if (linear.empty()) return white;
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float> values(linear.pixels());
    for (std::size_t pixel = 0; pixel < values.size(); ++pixel) values[pixel] = linear.pixel(pixel)[c];
    auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    float value = values[static_cast<std::size_t>(place)];
    white[c] = value > 0.0f ? value : 1.0f;
  }
  return white;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? digits[group >> (18U - 6U * static_cast<unsigned>(k)) & 63U] : '=';
  }
  return text;
}

std::string pngDataUri(const image::Image& encoded) {
  return "data:image/png;base64," + base64(image::encodePng(encoded, 8));
}

}  // namespace relucent::report
