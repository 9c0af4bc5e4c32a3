// SPDX-License-Identifier: MIT
#include "relucent/clustering/patches.h"

#include <algorithm>

#include "relucent/base/parallel.h"

namespace relucent::clustering {
namespace {

constexpr int apart = 1 << 24;  // between projectors, in pixels

}  // namespace

PixelPlaces::PixelPlaces(const Rasters& projectors) : place_(projectors.count()) {
  for (std::size_t device = 0; device < projectors.devices(); ++device) {
    Size size = projectors.size(device);
    parallelFor(0, size.count(), 4096, [&](std::size_t local) {
      Pixel place = pixelAt(size, local);
      place.x += static_cast<int>(device) * apart;
      place_[projectors.offset(device) + local] = place;
    });
  }
}

const std::vector<std::uint32_t>& PatchFinder::patchesOf(std::span<const Connection> row, double radius) {
  label_.resize(row.size());
  patches_ = visit(row, radius, [&](std::size_t i, std::size_t patch, std::size_t) {
    label_[i] = static_cast<std::uint32_t>(patch);
  });
  return label_;
}

std::span<const Connection> bright(std::span<const Connection> row, const ClusteringSettings& settings) {
  if (row.empty()) return row;
  double least = std::max(static_cast<double>(settings.leastLuminance),
                          settings.leastShare * static_cast<double>(row.front().luminance));
  if (static_cast<double>(row.back().luminance) >= least) return row;
  auto end = std::partition_point(row.begin(), row.end(), [&](const Connection& connection) {
    return static_cast<double>(connection.luminance) >= least;
  });
  return row.first(std::max<std::size_t>(1, static_cast<std::size_t>(end - row.begin())));
}

}  // namespace relucent::clustering
