// SPDX-License-Identifier: MIT
#include "views/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/image/colour.h"
#include "theme/tokens.h"

namespace relucent::gui {
namespace {

std::array<QRgb, 256> tableOf(ColourMap map) {
  std::array<QRgb, 256> table;
  std::transform(image::coloursOf(map).begin(), image::coloursOf(map).end(), table.begin(),
                 [](const image::Rgb8& colour) { return qRgb(colour[0], colour[1], colour[2]); });
  return table;
}

const std::array<QRgb, 256>& table(ColourMap map) {
  static const std::array<QRgb, 256> cividis = tableOf(ColourMap::cividis);
  static const std::array<QRgb, 256> viridis = tableOf(ColourMap::viridis);
  return map == ColourMap::cividis ? cividis : viridis;
}

}  // namespace

double ColourScale::place(double value) const {
  if (!std::isfinite(value) || (logarithmic && value <= 0.0)) return std::numeric_limits<double>::quiet_NaN();
  double share = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
}

QColor qtColourAt(ColourMap map, double place) {
  const image::Rgb8 colour = image::colourAt(map, place);
  return {colour[0], colour[1], colour[2]};
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
