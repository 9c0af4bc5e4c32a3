// SPDX-License-Identifier: MIT
#include "relucent/pipeline/report_pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/image/colour.h"
#include "relucent/image/picture_files.h"

namespace relucent::pipeline {
namespace {

using Anchors = std::array<std::array<int, 3>, 9>;
constexpr Anchors viridisAnchors{{{68, 1, 84},
                                  {71, 44, 122},
                                  {59, 81, 139},
                                  {44, 113, 142},
                                  {33, 144, 141},
                                  {39, 173, 129},
                                  {92, 200, 99},
                                  {170, 220, 50},
                                  {253, 231, 37}}};
constexpr Anchors cividisAnchors{{{0, 34, 78},
                                  {26, 56, 111},
                                  {67, 78, 108},
                                  {98, 100, 111},
                                  {125, 124, 120},
                                  {154, 148, 119},
                                  {187, 174, 109},
                                  {220, 202, 90},
                                  {254, 232, 56}}};
// What has no value: darker than either map's first colour, and another hue.
constexpr std::array<float, 3> noValue{0x16 / 255.0f, 0x18 / 255.0f, 0x1e / 255.0f};

}  // namespace

std::array<float, 3> colorOf(ColorMap map, double value) {
  const Anchors& anchors = map == ColorMap::viridis ? viridisAnchors : cividisAnchors;
  double place = std::clamp(value, 0.0, 1.0) * static_cast<double>(anchors.size() - 1);
  auto first = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  double t = place - static_cast<double>(first);
  std::array<float, 3> color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = static_cast<float>(((1.0 - t) * anchors[first][c] + t * anchors[first + 1][c]) / 255.0);
  return color;
}

image::Image painted(const image::Image& values, ColorMap map, double low, double high) {
  require(values.channels() == 1 && high > low, "{} channels, from {} to {}", values.channels(), low, high);
  image::Image result(values.size(), 3);
  for (std::size_t pixel = 0; pixel < values.pixels(); ++pixel) {
    double value = static_cast<double>(values.data()[pixel]);
    std::array<float, 3> color = std::isnan(value) ? noValue : colorOf(map, (value - low) / (high - low));
    std::copy(color.begin(), color.end(), result.pixel(pixel).begin());
  }
  return result;
}

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

}  // namespace relucent::pipeline
