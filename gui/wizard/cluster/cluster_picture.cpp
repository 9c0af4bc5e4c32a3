// SPDX-License-Identifier: MIT
#include "wizard/cluster/cluster_picture.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/clustering/clustering.h"
#include "theme/tokens.h"

namespace relucent::gui {

QImage clusterPicture(const std::vector<std::uint32_t>& map, const std::vector<std::uint8_t>& tints,
                      const std::vector<std::uint8_t>& borders, const QImage& surface) {
  auto pixels = static_cast<std::size_t>(surface.width()) * static_cast<std::size_t>(surface.height());
  require(map.size() == pixels && borders.size() == pixels, "{} clusters and {} borders for {} pixels",
          map.size(), borders.size(), pixels);
  QImage under = surface.convertToFormat(QImage::Format_RGB32);
  QImage image(under.size(), QImage::Format_RGB32);
  std::size_t at = 0;
  for (int y = 0; y < image.height(); ++y) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
    const auto* light = reinterpret_cast<const QRgb*>(under.constScanLine(y));
    for (int x = 0; x < image.width(); ++x, ++at) {
      if (map[at] == clustering::noCluster) {
        line[x] = qRgb(qRed(light[x]) / 4, qGreen(light[x]) / 4, qBlue(light[x]) / 4);
        continue;
      }
      QRgb tint = clusterPalette[tints[map[at]]].rgb();
      double strength = (borders[at] != 0 ? 0.45 : 1.0) * (0.3 + 0.7 * qGray(light[x]) / 255.0);
      auto mix = [strength](int a, int b) {
        return std::clamp(static_cast<int>(strength * (0.75 * a + 0.25 * b)), 0, 255);
      };
      line[x] = qRgb(mix(qRed(tint), qRed(light[x])), mix(qGreen(tint), qGreen(light[x])),
                     mix(qBlue(tint), qBlue(light[x])));
    }
  }
  return image;
}

QImage clusterOutline(const std::vector<std::uint32_t>& map, Size size, std::uint32_t cluster) {
  require(map.size() == size.count(), "{} clusters for {} pixels", map.size(), size.count());
  QImage image(size.width, size.height, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  auto isInside = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < size.width && y < size.height && map[indexOf(size, {x, y})] == cluster;
  };
  QRgb edge = colours(Look::dark).text.rgb();
  for (int y = 0; y < size.height; ++y) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < size.width; ++x)
      if (isInside(x, y) &&
          !(isInside(x - 1, y) && isInside(x + 1, y) && isInside(x, y - 1) && isInside(x, y + 1)))
        line[x] = edge;
  }
  return image;
}

}  // namespace relucent::gui
