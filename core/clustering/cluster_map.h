// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/base/raster.h"

namespace relucent::clustering {

/// Assigns a colour number to every cluster, so that clusters that touch in a map differ if `colours`
/// suffice: greedily in the order of the clusters, the least used colour that no neighbour has. Neighbours
/// are pixels above, below and beside each other in the same device.
/// `map`: per pixel a cluster or noCluster, see Clustering.  Shapes: one number a cluster.
std::vector<std::uint8_t> clusterColours(const std::vector<std::uint32_t>& map, const Rasters& rasters,
                                         std::size_t clusters, int colours);

/// Per pixel: the pixel to its right or below belongs to another cluster.
std::vector<std::uint8_t> clusterBorders(const std::vector<std::uint32_t>& map, const Rasters& rasters);

}  // namespace relucent::clustering
