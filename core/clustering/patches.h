// SPDX-License-Identifier: MIT
#pragma once

#include "clustering/clustering.h"

namespace relucent {

/// Where every projector pixel is; projectors stand too far apart for a patch to reach two.
class PixelPlaces {
 public:
  explicit PixelPlaces(const Rasters& projectors);
  bool near(std::uint32_t a, std::uint32_t b, double squaredRadius) const {
    double dx = place_[a].x - place_[b].x, dy = place_[a].y - place_[b].y;
    return dx * dx + dy * dy <= squaredRadius;
  }

 private:
  std::vector<Pixel> place_;
};

/// Lines 2 to 11 for one camera pixel: the patch of each of a row's connections; patches are numbered as
/// they are found, each begins with its brightest.
class PatchFinder {
 public:
  PatchFinder(const PixelPlaces& places, double radius) : places_(places), squaredRadius_(radius * radius) {}
  /// The result is valid until the next call.
  const std::vector<std::uint32_t>& patchesOf(std::span<const Connection> row);
  std::size_t patches() const { return patches_; }

 private:
  const PixelPlaces& places_;
  double squaredRadius_;
  std::size_t patches_ = 0;
  std::vector<std::uint32_t> label_, unlabelled_;
};

/// A row's connections that are bright enough to take part.
std::span<const Connection> bright(std::span<const Connection> row, const ClusteringSettings& settings);

/// The brightest of a projector pixel's connections.
struct Dominant {
  float luminance = 0.0f;  // 0: none
  std::uint32_t row = 0;
  std::size_t place = 0;
};

/// Which connections stay, by place in the graph.
struct KeptConnections {
  std::vector<std::uint8_t> kept;
  std::vector<std::uint8_t> lit;  // per projector pixel: connected before anything was cut
  std::size_t reinserted = 0;
};

/// Lines 1 to 20.
KeptConnections cutPatches(const ConnectionGraph& graph, const PixelPlaces& places,
                           const ClusteringSettings& settings, Progress& progress);

/// Per projector pixel for which wanted(pixel) the brightest connection for which among(place), of equals the
/// one to the lower camera pixel.
std::vector<Dominant> dominantConnections(const ConnectionGraph& graph, const ClusteringSettings& settings,
                                          const std::vector<std::uint8_t>& wantedPixels,
                                          const std::vector<std::uint8_t>* amongPlaces);

}  // namespace relucent
