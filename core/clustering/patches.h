// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "relucent/clustering/clustering.h"

namespace relucent::clustering {

/// Positions of all projector pixels; projectors are placed so far apart that no patch reaches two.
class PixelPlaces {
 public:
  explicit PixelPlaces(const Rasters& projectors);
  Pixel of(std::uint32_t pixel) const { return place_[pixel]; }

 private:
  std::vector<Pixel> place_;
};

/// Lines 2 to 11 for one camera pixel: patches are numbered in the order of their brightest connections, with
/// which they begin.
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

/// Calls visit(k) for every k below `count` with kept[k] == 1; skips zeros eight at a time.
template <typename Visit>
void forEachKept(const std::uint8_t* kept, std::size_t count, const Visit& visit) {
  static_assert(std::endian::native == std::endian::little);
  std::size_t k = 0;
  for (; k + 8 <= count; k += 8) {
    std::uint64_t flags = 0;
    std::memcpy(&flags, kept + k, 8);
    for (; flags != 0; flags &= flags - 1) visit(k + static_cast<std::size_t>(std::countr_zero(flags)) / 8);
  }
  for (; k < count; ++k)
    if (kept[k]) visit(k);
}

template <typename Join>
std::size_t PatchFinder::visit(std::span<const Connection> row, double radius, const Join& join) {
  // Squared distances are integers.
  auto reach = static_cast<std::int64_t>(radius * radius);
  auto isNear = [reach](Pixel a, Pixel b) {
    std::int64_t dx = a.x - b.x, dy = a.y - b.y;
    return dx * dx + dy * dy <= reach;
  };
  if (row.empty()) return 0;
  place_.resize(row.size());
  unlabelled_.resize(row.size());
  // Rows are sorted: the first unlabelled connection is the brightest. Most belong to the first patch.
  std::size_t left = 0;
  Pixel centre = places_->of(row.front().pixel);
  for (std::size_t i = 0; i < row.size(); ++i) {
    Pixel place = places_->of(row[i].pixel);
    if (isNear(centre, place)) {
      join(i, std::size_t{0}, std::size_t{0});
    } else {
      place_[left] = place;
      unlabelled_[left++] = static_cast<std::uint32_t>(i);
    }
  }
  std::size_t patch = 1;
  for (; left > 0; ++patch) {
    std::size_t count = std::exchange(left, 0), brightest = unlabelled_.front();
    centre = place_.front();
    for (std::size_t u = 0; u < count; ++u) {
      Pixel place = place_[u];
      std::uint32_t i = unlabelled_[u];
      if (isNear(centre, place)) {
        join(i, patch, brightest);
      } else {
        place_[left] = place;
        unlabelled_[left++] = i;
      }
    }
  }
  return patch;
}

}  // namespace relucent::clustering
