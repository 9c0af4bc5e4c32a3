// SPDX-License-Identifier: MIT
#include "relucent/monitoring/shadow_map.h"

#include <algorithm>
#include <map>

namespace relucent::monitoring {
namespace {

constexpr std::size_t mostSamples = 4500;
constexpr double leastOfSample = 0.02;  // of a sample's light: what sends less does not matter there
constexpr int smallestCell = 2;

}  // namespace

ShadowMap::ShadowMap(const WatchedVenue& venue, int mostAcross) {
  const std::vector<std::uint32_t>& even = venue.sampling.even;
  const std::size_t step = std::max<std::size_t>(1, (even.size() + mostSamples - 1) / mostSamples);
  for (std::size_t i = 0; i < even.size(); i += step) samples_.push_back(even[i]);

  const Rasters& rasters = venue.transport.rasters();
  std::size_t first = 0;
  for (const Size& size : rasters.sizes()) {
    int side = smallestCell;
    while (std::max(size.width, size.height) > side * mostAcross) side *= 2;
    const Size cells{(size.width + side - 1) / side, (size.height + side - 1) / side};
    grids_.push_back({side, cells, first});
    first += cells.count();
    projectorOf_.insert(projectorOf_.end(), cells.count(), static_cast<std::uint8_t>(grids_.size() - 1));
  }
  cellsOf_.resize(samples_.size());
  samplesOf_.resize(cells());
  flood_.assign(samples_.size() * projectors(), 0.0f);
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    std::map<std::size_t, float> light;  // by cell
    float all = 0.0f;
    for (const SampledTransport::Arrival& one : venue.transport.arrivalsOf(samples_[s])) {
      flood_[s * projectors() + one.projector] += one.light;
      all += one.light;
      const Grid& grid = grids_[one.projector];
      const transport::Block& from = one.from;
      if (std::max(from.x1 - from.x0, from.y1 - from.y0) > 2 * grid.side) continue;
      for (int v = from.y0 / grid.side; v * grid.side < from.y1; ++v)
        for (int u = from.x0 / grid.side; u * grid.side < from.x1; ++u) {
          const int across = std::min(from.x1, (u + 1) * grid.side) - std::max(from.x0, u * grid.side);
          const int down = std::min(from.y1, (v + 1) * grid.side) - std::max(from.y0, v * grid.side);
          light[grid.first + indexOf(grid.cells, {u, v})] +=
              one.light * static_cast<float>(across * down) / static_cast<float>(from.count());
        }
    }
    for (const auto& [cell, of] : light) {
      const float own = floodOf(s, projectorOf_[cell]);
      if (of < leastOfSample * static_cast<double>(all) || own <= 0.0f) continue;
      cellsOf_[s].push_back({static_cast<std::uint32_t>(cell), std::min(1.0f, of / own)});
      samplesOf_[cell].push_back({static_cast<std::uint32_t>(s), std::min(1.0f, of / own)});
    }
  }
}

std::vector<std::size_t> ShadowMap::around(std::size_t cell) const {
  const Grid& grid = grids_[projectorOf_[cell]];
  const Pixel at = pixelAt(grid.cells, cell - grid.first);
  std::vector<std::size_t> beside;
  for (int v = std::max(0, at.y - 1); v <= std::min(grid.cells.height - 1, at.y + 1); ++v)
    for (int u = std::max(0, at.x - 1); u <= std::min(grid.cells.width - 1, at.x + 1); ++u)
      if (u != at.x || v != at.y) beside.push_back(grid.first + indexOf(grid.cells, {u, v}));
  return beside;
}

}  // namespace relucent::monitoring
