// SPDX-License-Identifier: MIT
#include "relucent/image/colour_map.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace relucent::image {
namespace {

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

}  // namespace relucent::image
