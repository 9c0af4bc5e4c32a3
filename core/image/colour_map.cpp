// SPDX-License-Identifier: MIT
#include "relucent/image/colour_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "relucent/base/require.h"

namespace relucent::image {
namespace {

// What has no value: darker than either map's first colour, and another hue.
constexpr Rgb8 noValue{0x16, 0x18, 0x1e};

std::array<Rgb8, 256> tableOf(int map) {
  cv::Mat places(1, 256, CV_8U), colours;
  for (int i = 0; i < 256; ++i) places.at<uchar>(0, i) = static_cast<uchar>(i);
  cv::applyColorMap(places, colours, map);
  std::array<Rgb8, 256> table;
  for (int i = 0; i < 256; ++i) {
    const cv::Vec3b bgr = colours.at<cv::Vec3b>(0, i);
    table[static_cast<std::size_t>(i)] = {bgr[2], bgr[1], bgr[0]};
  }
  return table;
}

}  // namespace

const std::array<Rgb8, 256>& coloursOf(ColourMap map) {
  static const std::array<Rgb8, 256> cividis = tableOf(cv::COLORMAP_CIVIDIS);
  static const std::array<Rgb8, 256> viridis = tableOf(cv::COLORMAP_VIRIDIS);
  return map == ColourMap::cividis ? cividis : viridis;
}

Rgb8 colourAt(ColourMap map, double place) {
  return coloursOf(map)[static_cast<std::size_t>(std::lround(std::clamp(place, 0.0, 1.0) * 255.0))];
}

Image painted(const Image& values, ColourMap map, double low, double high) {
  require(values.channels() == 1 && high > low, "{} channels, from {} to {}", values.channels(), low, high);
  Image result(values.size(), 3);
  for (std::size_t pixel = 0; pixel < values.pixels(); ++pixel) {
    double value = static_cast<double>(values.data()[pixel]);
    const Rgb8 colour = std::isnan(value) ? noValue : colourAt(map, (value - low) / (high - low));
    std::transform(colour.begin(), colour.end(), result.pixel(pixel).begin(),
                   [](std::uint8_t code) { return static_cast<float>(code) / 255.0f; });
  }
  return result;
}

}  // namespace relucent::image
