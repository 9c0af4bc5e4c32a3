// SPDX-License-Identifier: MIT
#pragma once

#include "clustering/patches.h"

namespace relucent {

/// Clusters as connected components of the kept connections, numbered by their lowest projector pixel.
struct Partition {
  std::vector<std::uint32_t> camera, projector;
  std::vector<ClusterSize> sizes;  // connections not yet counted
};

Partition connectedComponents(const ConnectionGraph& graph, const KeptConnections& connections);

/// The largest clusters along the strongest connections that hold at most `most` projector pixels (see
/// clustered()). Cuts from `connections` what runs between clusters.
Partition cappedComponents(const ConnectionGraph& graph, const ClusteringSettings& settings,
                           KeptConnections& connections, Progress& progress);

}  // namespace relucent
