// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "relucent/transport/transport_matrix.h"

namespace relucent::transport {

/// A row of T: what one camera pixel sees of every projector pixel.
struct PixelFootprint {
  std::vector<float> luminance;  // per projector pixel, of the camera pixel's signal from it at white
  std::size_t pixels = 0;        // that light it
  std::size_t strongest = 0;     // projector pixel; 0 if none does
  double nearShare = 0.0;        // of the row's light that comes from within `near` of the strongest
};

/// `near`: in projector pixels. Source: T^T of light in that camera pixel alone; luminance of ITU-R BT.709.
/// Contract: row < transport.cameras().count().
PixelFootprint footprintOf(const TransportMatrix& transport, std::size_t row, double near = 4.0);

/// The pixel of one projector that lights the camera pixel most, numbered within the projector; none where it
/// does not light it.  Contract: the footprint is of T with these projectors, device < projectors.devices().
std::optional<std::size_t> strongestPixel(const PixelFootprint& footprint, const Rasters& projectors,
                                          std::size_t device);

/// Which device has pixel `index` of all devices' pixels.  Contract: index < rasters.count().
std::size_t deviceOfPixel(const Rasters& rasters, std::size_t index);

/// A column of T: luminance of every camera pixel's signal from one projector pixel at white.
/// Contract: pixel < transport.projectors().count().
std::vector<float> lightOfPixel(const TransportMatrix& transport, std::size_t pixel);

}  // namespace relucent::transport
