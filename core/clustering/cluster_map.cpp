// SPDX-License-Identifier: MIT
#include "relucent/clustering/cluster_map.h"

#include <algorithm>
#include <numeric>

#include "relucent/base/error.h"
#include "relucent/clustering/clustering.h"

namespace relucent::clustering {
namespace {

/// Calls visit(index, neighbour) for every pixel and the pixels to its right and below it.
template <typename Visit>
void forNeighbours(const Rasters& rasters, const Visit& visit) {
  for (std::size_t device = 0; device < rasters.devices(); ++device) {
    Size size = rasters.size(device);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        std::size_t here = rasters.offset(device) + indexOf(size, {x, y});
        if (x + 1 < size.width) visit(here, here + 1);
        if (y + 1 < size.height) visit(here, here + static_cast<std::size_t>(size.width));
      }
  }
}

/// For every cluster those that it touches, once for each pair of pixels: list[start[c]] to list[start[c +
/// 1]].
struct Neighbours {
  std::vector<std::uint32_t> start, list;
};

Neighbours neighboursOf(const std::vector<std::uint32_t>& map, const Rasters& rasters, std::size_t clusters) {
  auto forTouching = [&](const auto& visit) {
    forNeighbours(rasters, [&](std::size_t a, std::size_t b) {
      std::uint32_t one = map[a], other = map[b];
      if (one == other || one == noCluster || other == noCluster) return;
      visit(one, other);
      visit(other, one);
    });
  };
  Neighbours neighbours{std::vector<std::uint32_t>(clusters + 1, 0), {}};
  forTouching([&](std::uint32_t one, std::uint32_t) { ++neighbours.start[one]; });
  std::partial_sum(neighbours.start.begin(), neighbours.start.end(), neighbours.start.begin());
  neighbours.list.resize(neighbours.start.back());
  forTouching(
      [&](std::uint32_t one, std::uint32_t other) { neighbours.list[--neighbours.start[one]] = other; });
  return neighbours;
}

}  // namespace

std::vector<std::uint8_t> clusterColours(const std::vector<std::uint32_t>& map, const Rasters& rasters,
                                         std::size_t clusters, int colours) {
  require(map.size() == rasters.count(), "{} values for {} pixels", map.size(), rasters.count());
  require(colours > 0 && colours < 256, "{} colours", colours);
  Neighbours neighbours = neighboursOf(map, rasters, clusters);
  constexpr std::uint8_t none = 255;
  std::vector<std::uint8_t> colour(clusters, none);
  std::vector<std::size_t> used(static_cast<std::size_t>(colours), 0), taken(used.size());
  for (std::size_t cluster = 0; cluster < clusters; ++cluster) {
    std::fill(taken.begin(), taken.end(), 0);
    for (std::uint32_t k = neighbours.start[cluster]; k < neighbours.start[cluster + 1]; ++k)
      if (std::uint8_t theirs = colour[neighbours.list[k]]; theirs != none) ++taken[theirs];
    std::size_t best = 0;
    for (std::size_t candidate = 1; candidate < used.size(); ++candidate) {
      auto cost = [&](std::size_t c) { return std::pair(taken[c], used[c]); };
      if (cost(candidate) < cost(best)) best = candidate;
    }
    colour[cluster] = static_cast<std::uint8_t>(best);
    ++used[best];
  }
  return colour;
}

std::vector<std::uint8_t> clusterBorders(const std::vector<std::uint32_t>& map, const Rasters& rasters) {
  require(map.size() == rasters.count(), "{} values for {} pixels", map.size(), rasters.count());
  std::vector<std::uint8_t> border(map.size(), 0);
  forNeighbours(rasters, [&](std::size_t here, std::size_t there) {
    if (map[here] != map[there]) border[here] = 1;
  });
  return border;
}

}  // namespace relucent::clustering
