// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/clustering/grouping.h"

namespace relucent::clustering {

/// T~ and its error.
struct Approximation {
  transport::TransportMatrix transport;
  std::vector<float> error;  // per camera pixel, as in Clustering
};

/// Line 21: the kept connections, scaled (see clustered()), as a matrix, and its error without expanding T,
///   |T_i - T~_i|^2 = |T_i|^2 + sum over kept (|T~_ij|^2 - 2 T_ij . T~_ij).
/// Throws: Cancelled.
Approximation scaledToFloodlight(const ConnectionGraph& graph, const Grouping& grouping,
                                 const ClusteringSettings& settings, Progress& progress);

/// The same error, without storing T~.  Throws: Cancelled.
std::vector<float> errorOfScaled(const ConnectionGraph& graph, const Grouping& grouping,
                                 const ClusteringSettings& settings, Progress& progress);

/// Median and 95th percentile of the lit camera pixels' errors.
void summariseErrors(const Grouping& grouping, const std::vector<float>& error,
                     ClusteringStatistics& statistics);

}  // namespace relucent::clustering
