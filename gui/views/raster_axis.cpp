// SPDX-License-Identifier: MIT
#include "views/raster_axis.h"

#include <algorithm>
#include <cmath>

#include "relucent/charts/axis.h"
#include "views/number_text.h"

namespace relucent::gui {
namespace {

struct Place {
  std::size_t device = 0;
  Pixel pixel;
};

Place placeOf(const Rasters& rasters, std::size_t index) {
  std::size_t device = 0;
  while (device + 1 < rasters.devices() && index >= rasters.offset(device + 1)) ++device;
  return {device, pixelAt(rasters.size(device), index - rasters.offset(device))};
}

QString ofDevice(const Rasters& rasters, std::size_t device, const QString& text) {
  return rasters.devices() > 1 ? QString("%1: %2").arg(device + 1).arg(text) : text;
}

}  // namespace

QString pixelText(const Rasters& rasters, std::size_t index) {
  Place place = placeOf(rasters, index);
  return ofDevice(rasters, place.device, placeText(place.pixel.x, place.pixel.y));
}

std::vector<RasterTick> rasterTicks(const Rasters& rasters, double first, double last, int count) {
  std::vector<RasterTick> ticks;
  if (rasters.count() == 0 || !(last > first) || count < 1) return ticks;
  std::size_t middle =
      std::min(static_cast<std::size_t>(std::max(0.0, (first + last) / 2.0)), rasters.count() - 1);
  double width = rasters.size(placeOf(rasters, middle).device).width;
  if (last - first < count * width) {
    // Ticks stand in the middle of their pixels.
    for (const charts::Tick& tick : charts::Axis{first, last, false, {}}.ticks(count)) {
      double number = std::floor(tick.value);
      if (number < first || number + 1.0 > last || number + 1.0 > static_cast<double>(rasters.count()))
        continue;
      if (!ticks.empty() && ticks.back().place == number + 0.5) continue;
      ticks.push_back({number + 0.5, pixelText(rasters, static_cast<std::size_t>(number))});
    }
    return ticks;
  }
  for (std::size_t device = 0; device < rasters.devices(); ++device) {
    double offset = static_cast<double>(rasters.offset(device));
    Size size = rasters.size(device);
    double from = std::max(0.0, (first - offset) / size.width);
    double to = std::min(static_cast<double>(size.height), (last - offset) / size.width);
    if (!(to > from)) continue;
    double share = (to - from) * size.width / (last - first);
    int wanted = std::max(1, static_cast<int>(std::lround(share * count)));
    for (const charts::Tick& tick : charts::Axis{from, to, false, {}}.ticks(wanted)) {
      double line = std::floor(tick.value);
      if (line < from || line >= size.height) continue;
      ticks.push_back(
          {offset + line * size.width, ofDevice(rasters, device, QString::number(static_cast<int>(line)))});
    }
  }
  return ticks;
}

}  // namespace relucent::gui
