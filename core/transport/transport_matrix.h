// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/base/raster.h"
#include "relucent/transport/block_sparse.h"
#include "relucent/transport/leaf_groups.h"
#include "relucent/transport/leaf_row.h"
#include "relucent/transport/node_layout.h"

namespace relucent::transport {

/// The light transport between all projectors and all cameras of a rig,
///   camera = T * projector + e,      T = T' A,
/// where A computes a pattern's means over the nodes of its mean pyramid and T' ("leaves") has a column for
/// every node: light that arrives evenly from a wide area is one entry instead of thousands.
/// A leaf's value is the camera signal per second while its whole block is fully lit.
/// Leaves that neighbouring camera pixels see alike are held once for all of them: see LeafGroups.
/// Shapes: rows = camera pixels, columns = projector pixels, 3x3 blocks (paper eq. 2 and appendix).
/// Source: core/transport/README.md; Wetzstein & Bimber 2007, Sen et al. 2005.
class TransportMatrix {
 public:
  TransportMatrix() = default;
  /// Throws: std::logic_error unless leaves is cameras.count() x NodeLayout(projectors).count().
  TransportMatrix(Rasters cameras, Rasters projectors, BlockSparse leaves);
  /// With leaves that camera pixels share, beside those of their own.
  /// Throws: also unless own leaves share colours as nearAndFar() has them.
  TransportMatrix(Rasters cameras, Rasters projectors, BlockSparse own, LeafGroups groups);

  const Rasters& cameras() const { return cameras_; }
  const Rasters& projectors() const { return layout_.projectors(); }
  const NodeLayout& layout() const { return layout_; }
  /// All leaves that a camera pixel sees.
  LeafRow row(std::size_t pixel) const { return {own_, groups_, pixel, projectors().devices()}; }
  /// Those that it has for itself, a row for each camera pixel; all of them where there are no groups.
  const BlockSparse& ownLeaves() const { return own_; }
  const LeafGroups& groups() const { return groups_; }
  /// Leaves that are held, each once.
  std::size_t storedLeaves() const { return own_.blocks() + groups_.leaves().blocks(); }
  std::size_t bytes() const { return own_.bytes() + groups_.bytes(); }
  /// The same T without groups: every camera pixel has its leaves for itself.
  TransportMatrix flattened() const;
  /// Marks the leaves of a camera pixel that stay. Called from several threads.
  using KeepLeaves =
      std::function<void(std::size_t pixel, const LeafRow& leaves, std::vector<std::uint8_t>& keep)>;
  /// A shared leaf that every camera pixel keeps which sees it stays shared; else those that keep it have it
  /// for themselves.
  TransportMatrix filtered(const KeepLeaves& keep) const;
  /// Row r times the factor of each camera channel.
  TransportMatrix withRowsScaled(const Stack& factor) const;
  /// Every block of a camera pixel and a projector times `factor` of the two, value by value: its nine values
  /// are how each of the projector's channels arrives in each of the camera's.
  using LightFactor = std::function<ColourBlock(std::size_t pixel, std::size_t projector)>;
  TransportMatrix withLightScaled(const LightFactor& factor) const;
  /// The same of every block whose column is of a kind.  Contract: as of BlockSparse::withBlocksScaled().
  TransportMatrix withColoursScaled(const ColumnKinds& kinds, const BlockSparse::BlockFactor& factor) const&;
  /// The same in place.
  TransportMatrix withColoursScaled(const ColumnKinds& kinds, const BlockSparse::BlockFactor& factor) &&;

  bool operator==(const TransportMatrix& other) const;

  /// Relighting, without e: what the cameras see under linear patterns. Shapes: projector -> camera stack.
  CameraStack apply(const ProjectorStack& projector) const;
  /// Dual photography: the projectors' view under light from the cameras. Shapes: camera -> projector stack.
  ProjectorStack applyTransposed(const CameraStack& camera) const;
  /// T 1: the flood image, with every projector pixel at full drive.
  CameraStack floodlight() const;
  /// 3x3 colour mixing of each camera pixel, the sum over its leaves.
  std::vector<ColourBlock> rowSums() const;
  /// The same of every projector by itself: [projector][row].
  std::vector<std::vector<ColourBlock>> rowSumsOfProjectors() const;

 private:
  TransportMatrix filteredSharing(const KeepLeaves& keep) const;

  Rasters cameras_;
  NodeLayout layout_;
  BlockSparse own_;
  LeafGroups groups_;
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
bool cutsNothing(const ThresholdSettings& settings);

/// Least strength that is kept, per row. The strongest leaf of a row is always kept, so that no row becomes
/// empty. Source: Wetzstein & Bimber 2007, section 3.
std::vector<float> thresholdLimits(const TransportMatrix& transport, const ThresholdSettings& settings);

/// Drops weak leaves, then rescales to `flood`.
/// Law: never adds energy beyond the flood image.  Throws: Error{usage} for wrong settings.
TransportMatrix thresholded(const TransportMatrix& transport, const ThresholdSettings& settings,
                            const CameraStack& flood);

}  // namespace relucent::transport
