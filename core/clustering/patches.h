// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>

#include "clustering/clustering.h"

namespace relucent {

/// Where every projector pixel is; projectors stand too far apart for a patch to reach two.
class PixelPlaces {
 public:
  explicit PixelPlaces(const Rasters& projectors);
  Pixel of(std::uint32_t pixel) const { return place_[pixel]; }

 private:
  std::vector<Pixel> place_;
};

/// Lines 2 to 11 for one camera pixel: patches are numbered as they are found, each begins with its
/// brightest.
class PatchFinder {
 public:
  explicit PatchFinder(const PixelPlaces& places) : places_(&places) {}

  /// Calls join(connection, patch, centre) for each of a row's connections, patch by patch: `centre` is the
  /// patch's brightest connection. Returns the number of patches.
  template <typename Join>
  std::size_t visit(std::span<const Connection> row, double radius, const Join& join);

  /// The patch of each of a row's connections. Valid until the next call.
  const std::vector<std::uint32_t>& patchesOf(std::span<const Connection> row, double radius);
  std::size_t patches() const { return patches_; }

 private:
  const PixelPlaces* places_;
  std::size_t patches_ = 0;
  std::vector<Pixel> place_;
  std::vector<std::uint32_t> label_, unlabelled_;
};

/// A row's connections that are bright enough to take part.
std::span<const Connection> bright(std::span<const Connection> row, const ClusteringSettings& settings);

/// Calls visit(k) for every k below `count` where kept[k] is 1, not 0: eight at a time are passed over.
template <typename Visit>
void forKept(const std::uint8_t* kept, std::size_t count, const Visit& visit) {
  static_assert(std::endian::native == std::endian::little);
  for (std::size_t k = 0; k < count; k += 8) {
    std::uint64_t flags = 0;
    std::memcpy(&flags, kept + k, std::min<std::size_t>(8, count - k));
    for (; flags != 0; flags &= flags - 1) visit(k + static_cast<std::size_t>(std::countr_zero(flags)) / 8);
  }
}

template <typename Join>
std::size_t PatchFinder::visit(std::span<const Connection> row, double radius, const Join& join) {
  // Squared distances are whole numbers.
  auto reach = static_cast<std::int64_t>(radius * radius);
  auto isNear = [reach](Pixel a, Pixel b) {
    std::int64_t dx = a.x - b.x, dy = a.y - b.y;
    return dx * dx + dy * dy <= reach;
  };
  place_.resize(row.size());
  unlabelled_.resize(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    place_[i] = places_->of(row[i].pixel);
    unlabelled_[i] = static_cast<std::uint32_t>(i);
  }
  std::size_t patch = 0;
  for (std::size_t count = row.size(); count > 0; ++patch) {
    // Rows are sorted: the first unlabelled connection is the brightest.
    std::size_t centre = unlabelled_.front(), left = 0;
    for (std::size_t u = 0; u < count; ++u) {
      std::uint32_t i = unlabelled_[u];
      if (isNear(place_[centre], place_[i]))
        join(i, patch, centre);
      else
        unlabelled_[left++] = i;
    }
    count = left;
  }
  return patch;
}

}  // namespace relucent
