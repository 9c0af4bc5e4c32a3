// SPDX-License-Identifier: MIT
#pragma once

#include "clustering/patches.h"

namespace relucent {

/// T~ and how far it is from T.
struct Approximation {
  TransportMatrix transport;
  std::vector<float> error;  // per camera pixel, as in Clustering
};

/// Line 21: the kept connections, scaled (see clustered()), as a matrix, and its error without expanding T,
///   |T_i - T~_i|^2 = |T_i|^2 + sum over kept (|T~_ij|^2 - 2 T_ij . T~_ij).
Approximation scaledToFloodlight(const ConnectionGraph& graph, const PixelPlaces& places,
                                 const KeptConnections& connections, const ClusteringSettings& settings,
                                 Progress& progress);

}  // namespace relucent
