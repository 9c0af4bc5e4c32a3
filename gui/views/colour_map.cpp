// SPDX-License-Identifier: MIT
#include "views/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "relucent/base/error.h"
#include "relucent/image/colour.h"
#include "theme/tokens.h"

namespace relucent::gui {
namespace {

std::array<QRgb, 256> tableOf(int map) {
  cv::Mat places(1, 256, CV_8U), colours;
  for (int i = 0; i < 256; ++i) places.at<uchar>(0, i) = static_cast<uchar>(i);
  cv::applyColorMap(places, colours, map);
  std::array<QRgb, 256> table;
  for (int i = 0; i < 256; ++i) {
    cv::Vec3b bgr = colours.at<cv::Vec3b>(0, i);
    table[static_cast<std::size_t>(i)] = qRgb(bgr[2], bgr[1], bgr[0]);
  }
  return table;
}

const std::array<QRgb, 256>& table(ColourMap map) {
  static const std::array<QRgb, 256> cividis = tableOf(cv::COLORMAP_CIVIDIS);
  static const std::array<QRgb, 256> viridis = tableOf(cv::COLORMAP_VIRIDIS);
  return map == ColourMap::cividis ? cividis : viridis;
}

QRgb rgbAt(ColourMap map, double place) {
  auto index = static_cast<std::size_t>(std::lround(std::clamp(place, 0.0, 1.0) * 255.0));
  return table(map)[index];
}

}  // namespace

double ColourScale::place(double value) const {
  if (!std::isfinite(value) || (logarithmic && value <= 0.0)) return std::numeric_limits<double>::quiet_NaN();
  double share = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
}

QColor colourAt(ColourMap map, double place) {
  return QColor(rgbAt(map, place));
}

QImage mapped(std::span<const float> values, Size size, const ColourScale& scale) {
  require(values.size() == size.count(), "{} values for {} pixels", values.size(), size.count());
  QImage image(size.width, size.height, QImage::Format_RGB32);
  // As ColourScale::place() has it, with everything that all values share worked out before.
  const std::array<QRgb, 256>& colours = table(scale.map);
  QRgb none = invalidColour.rgb();
  double low = scale.logarithmic ? std::log(scale.low) : scale.low;
  double range = (scale.logarithmic ? std::log(scale.high) : scale.high) - low;
  for (int y = 0; y < size.height; ++y) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < size.width; ++x) {
      auto value = static_cast<double>(values[indexOf(size, {x, y})]);
      bool known = std::isfinite(value) && (!scale.logarithmic || value > 0.0);
      double share = known ? ((scale.logarithmic ? std::log(value) : value) - low) / range : 0.0;
      share = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
      line[x] = known ? colours[static_cast<std::size_t>(share * 255.0 + 0.5)] : none;
    }
  }
  return image;
}

QImage encodedPictureOf(const image::Image& encoded) {
  if (encoded.empty()) return {};
  QImage image(encoded.width(), encoded.height(), QImage::Format_RGB32);
  auto code = [](float value) {
    return std::isfinite(value) ? static_cast<int>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f)) : 0;
  };
  for (int y = 0; y < encoded.height(); ++y) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < encoded.width(); ++x)
      line[x] = qRgb(code(encoded.at(x, y, 0)), code(encoded.at(x, y, 1)), code(encoded.at(x, y, 2)));
  }
  return image;
}

QImage pictureOf(const image::Image& linear, float white) {
  if (linear.empty()) return {};
  return encodedPictureOf(image::viewed(linear, {white, white, white}));
}

}  // namespace relucent::gui
