// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/inverse/synthetic_transport.h"
#include "relucent/compensation/target.h"

namespace relucent::synthetic {

/// A venue that several cameras look at: each scene is what one of them sees of the same projector.
inline compensation::MeasuredVenue stackedViews(const std::vector<Scene>& scenes) {
  std::vector<Size> sizes;
  std::vector<float> fullScale;
  compensation::MeasuredVenue venue;
  for (const Scene& scene : scenes) {
    sizes.push_back(scene.transport.cameras().size(0));
    const transport::BlockSparse& leaves = scene.transport.ownLeaves();
    for (std::size_t row = 0; row < leaves.rows(); ++row) {
      float& largest = fullScale.emplace_back(0.0f);
      for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry)
        largest = std::max(largest, leaves.sizeOf(row, entry).largest);
    }
    venue.black.insert(venue.black.end(), scene.black.begin(), scene.black.end());
    venue.usable.insert(venue.usable.end(), scene.usable.begin(), scene.usable.end());
  }
  const Rasters cameras(sizes), projectors = scenes.front().transport.projectors();
  transport::BlockSparseBuilder builder(scenes.front().transport.layout().count(), fullScale);
  for (std::size_t camera = 0; camera < scenes.size(); ++camera) {
    const transport::BlockSparse& leaves = scenes[camera].transport.ownLeaves();
    for (std::size_t row = 0; row < leaves.rows(); ++row)
      for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry)
        builder.add(cameras.offset(camera) + row, leaves.column(entry), leaves.block(row, entry));
  }
  venue.transport = transport::TransportMatrix(cameras, projectors, builder.build());
  venue.flood = venue.transport.floodlight();
  venue.views = compensation::viewMap(venue.transport, venue.usable);
  return venue;
}

/// Two cameras of odd sizes before one projector; what they see has textures of its own.
inline compensation::MeasuredVenue twoViews() {
  return stackedViews(
      {makeScene({{50, 37}, {41, 29}, 2, 0.5, 1.2}), makeScene({{50, 37}, {33, 27}, 5, 0.5, 1.2})});
}

}  // namespace relucent::synthetic
