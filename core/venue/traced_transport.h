// SPDX-License-Identifier: MIT
#pragma once

#include "base/progress.h"
#include "transport/block_sparse.h"
#include "venue/tracer.h"

namespace relucent {

/// A scene's light transport as traced, scaled to camera signal per second.
struct TracedTransport {
  /// Rows: nodes of the projectors' pyramids; columns: camera pixels. Stored this way round because most
  /// patterns are mostly dark, and dark rows cost nothing.
  BlockSparse cameraByNode;
  /// What the rows' fixed-point values are relative to; with the values it determines the matrix to the bit.
  std::vector<float> fullScale;
  /// The camera's picture under room light, white = 1. Shape: 3 * camera pixels.
  Stack roomLight;
};

/// Traces every camera pixel, then scales everything so that the flood image's bright pixels (its 99th
/// percentile) reach `brightSignal` per second.
/// Throws: Cancelled.
TracedTransport traceTransport(const Scene& scene, const TracerSettings& settings, double brightSignal,
                               Progress& progress);

}  // namespace relucent
