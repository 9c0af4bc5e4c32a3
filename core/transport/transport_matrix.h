// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/base/raster.h"
#include "relucent/transport/block_sparse.h"
#include "relucent/transport/node_layout.h"

namespace relucent::transport {

/// The light transport between all projectors and all cameras of a rig,
///   camera = T * projector + e,      T = T' A,
/// where A computes a pattern's means over the nodes of its mean pyramid and T' ("leaves") has a column for
/// every node: light that arrives evenly from a wide area is one entry instead of thousands.
/// A leaf's value is the camera signal per second while its whole block is fully lit.
/// Shapes: rows = camera pixels, columns = projector pixels, 3x3 blocks (paper eq. 2 and appendix).
/// Source: core/transport/README.md; Wetzstein & Bimber 2007, Sen et al. 2005.
class TransportMatrix {
 public:
  TransportMatrix() = default;
  /// Throws: std::logic_error unless leaves is cameras.count() x NodeLayout(projectors).count().
  TransportMatrix(Rasters cameras, Rasters projectors, BlockSparse leaves);

  const Rasters& cameras() const { return cameras_; }
  const Rasters& projectors() const { return layout_.projectors(); }
  const NodeLayout& layout() const { return layout_; }
  const BlockSparse& leaves() const { return leaves_; }

  /// Relighting, without e: what the cameras see under linear patterns. Shapes: projector -> camera stack.
  CameraStack apply(const ProjectorStack& projector) const;
  /// Dual photography: the projectors' view under light from the cameras. Shapes: camera -> projector stack.
  ProjectorStack applyTransposed(const CameraStack& camera) const;
  /// T 1: the flood image, with every projector pixel at full drive.
  CameraStack floodlight() const;
  /// 3x3 colour mixing of each camera pixel, the sum over its leaves.
  std::vector<ColourBlock> rowSums() const;

 private:
  Rasters cameras_;
  NodeLayout layout_;
  BlockSparse leaves_;
};

/// Rows scaled, per camera channel, so that T 1 equals `flood`: what a threshold removed is restored in
/// proportion (paper, Algorithm 1, line 21). Channels where T 1 is at most `floor` are left unchanged.
TransportMatrix rescaledToFloodlight(const TransportMatrix& transport, const CameraStack& flood,
                                     float floor = 0.0f);

/// Thresholding settings. A leaf's strength is the largest magnitude in its 3x3 block per projector pixel of
/// its node; a leaf is dropped if that is below any of the limits. By default nothing is dropped.
struct ThresholdSettings {
  float absolute = 0.0f;       // camera signal per second: the paper's "HDR value of a camera pixel"
  float shareOfRowMax = 0.0f;  // of the row's strongest single connection
  double energyKept =
      1.0;  // of the light in all leaves: the strongest leaves that hold at least this share are kept
};
std::vector<Message> problems(const ThresholdSettings& settings);

/// Least strength that is kept, per row. The strongest leaf of a row is always kept, so that no row becomes
/// empty. Source: Wetzstein & Bimber 2007, section 3.
std::vector<float> thresholdLimits(const TransportMatrix& transport, const ThresholdSettings& settings);

/// Drops weak leaves, then rescales to `flood`.
/// Law: never adds energy beyond the flood image.  Throws: Error{usage} for wrong settings.
TransportMatrix thresholded(const TransportMatrix& transport, const ThresholdSettings& settings,
                            const CameraStack& flood);

}  // namespace relucent::transport
