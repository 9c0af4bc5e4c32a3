// SPDX-License-Identifier: MIT
#include "relucent/transport/footprint.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/image/colour.h"

namespace relucent::transport {
namespace {

/// Light of the projector pixels of one device that are near one of them.
double lightNear(const std::vector<float>& luminance, const Rasters& projectors, std::size_t centre,
                 double radius) {
  const std::size_t device = deviceOfPixel(projectors, centre);
  Size size = projectors.size(device);
  Pixel middle = pixelAt(size, centre - projectors.offset(device));
  double sum = 0.0;
  for (std::size_t i = 0; i < size.count(); ++i) {
    Pixel pixel = pixelAt(size, i);
    double dx = pixel.x - middle.x, dy = pixel.y - middle.y;
    if (dx * dx + dy * dy <= radius * radius)
      sum += static_cast<double>(luminance[projectors.offset(device) + i]);
  }
  return sum;
}

}  // namespace

PixelFootprint footprintOf(const TransportMatrix& transport, std::size_t row, double near) {
  require(row < transport.cameras().count(), "row {} of {}", row, transport.cameras().count());
  CameraStack eye(3 * transport.cameras().count(), 0.0f);
  for (std::size_t channel = 0; channel < 3; ++channel)
    eye[3 * row + channel] = image::luminanceWeights[channel];
  ProjectorStack seen = transport.applyTransposed(eye);

  PixelFootprint footprint;
  footprint.luminance.resize(transport.projectors().count());
  double all = 0.0;
  for (std::size_t i = 0; i < footprint.luminance.size(); ++i) {
    float value = seen[3 * i] + seen[3 * i + 1] + seen[3 * i + 2];
    footprint.luminance[i] = value;
    all += static_cast<double>(value);
    if (value > 0.0f) ++footprint.pixels;
    if (value > footprint.luminance[footprint.strongest]) footprint.strongest = i;
  }
  if (all > 0.0)
    footprint.nearShare =
        lightNear(footprint.luminance, transport.projectors(), footprint.strongest, near) / all;
  return footprint;
}

std::optional<std::size_t> strongestPixel(const PixelFootprint& footprint, const Rasters& projectors,
                                          std::size_t device) {
  require(footprint.luminance.size() == projectors.count(), "a footprint of {} pixels is not of {}",
          footprint.luminance.size(), projectors.count());
  const auto begin = footprint.luminance.begin() + static_cast<std::ptrdiff_t>(projectors.offset(device));
  const auto end = begin + static_cast<std::ptrdiff_t>(projectors.size(device).count());
  const auto strongest = std::max_element(begin, end);
  if (strongest == end || !(*strongest > 0.0f)) return std::nullopt;
  return static_cast<std::size_t>(strongest - begin);
}

std::size_t deviceOfPixel(const Rasters& rasters, std::size_t index) {
  require(index < rasters.count(), "pixel {} of {}", index, rasters.count());
  std::size_t device = 0;
  while (index >= rasters.offset(device) + rasters.size(device).count()) ++device;
  return device;
}

std::vector<float> lightOfPixel(const TransportMatrix& transport, std::size_t pixel) {
  require(pixel < transport.projectors().count(), "pixel {} of {}", pixel, transport.projectors().count());
  ProjectorStack white(3 * transport.projectors().count(), 0.0f);
  for (std::size_t channel = 0; channel < 3; ++channel) white[3 * pixel + channel] = 1.0f;
  CameraStack seen = transport.apply(white);
  std::vector<float> luminance(transport.cameras().count());
  for (std::size_t i = 0; i < luminance.size(); ++i)
    luminance[i] = image::luminanceOf(seen[3 * i], seen[3 * i + 1], seen[3 * i + 2]);
  return luminance;
}

}  // namespace relucent::transport
