// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/progress.h"
#include "relucent/transport/block_sparse.h"
#include "relucent/venue/tracer.h"

namespace relucent::venue {

/// The traced light transport of a scene, scaled to camera signal per second.
struct TracedTransport {
  /// Rows: nodes of the projectors' pyramids; columns: camera pixels. Stored transposed because most patterns
  /// are mostly dark, and dark rows are skipped.
  transport::BlockSparse cameraByNode;
  /// Full scale of the fixed-point values of each row; together with the values it determines the matrix
  /// exactly.
  std::vector<float> fullScale;
  /// The cameras' pictures under room light, white = 1. Shape: 3 * camera pixels.
  CameraStack roomLight;
};

/// Traces every pixel of all cameras, then scales everything so that the flood image's bright pixels (its
/// 99th percentile) reach `brightSignal` per second. Throws: Cancelled.
TracedTransport traceTransport(const Scene& scene, const TracerSettings& settings, double brightSignal,
                               Progress& progress);

/// The same in the units in which the cameras of another scene, `known`, have the flood image `flood`.
/// Throws: Cancelled.
TracedTransport traceInUnitsOf(const Scene& known, const CameraStack& flood, const Scene& scene,
                               const TracerSettings& settings, Progress& progress);

}  // namespace relucent::venue
