// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "relucent/transport/acquisition.h"

namespace relucent::transport {

/// How much less closely a venue is looked at.
struct Coarsening {
  int cameras = 0;     // 2^this x 2^this pixels of a camera are one
  int projectors = 0;  // likewise
  int leaves = 0;      // no leaf is finer than this level of the coarse projectors
};

/// The same devices with 2^levels x 2^levels pixels joined, at the right and lower border fewer.
Rasters coarsened(const Rasters& devices, int levels);

/// A row of T, leaf by leaf: its node and its block.
using AddLeaf = std::function<void(std::size_t node, const ColourBlock& block)>;
using RowLeaves = std::function<void(std::size_t row, const AddLeaf& add)>;

/// T of a venue that is looked at less closely: what the joined camera pixels see on average of patterns that
/// are even within the joined projector pixels.
///   T_coarse(b, n) = mean over the rows i in b that count, sum over the leaves j in n,  T_i,j
/// Law: T_coarse p = joined(T q), where q shows each value of p in all pixels that it joins; exact where no
/// block is cut by the border.
/// Shapes: `counts` a value each camera pixel. `leavesOf` is called on all cores, in any order.
TransportMatrix coarsenedTransport(const Rasters& cameras, const NodeLayout& layout, const CameraMask& counts,
                                   const Coarsening& coarsening, const RowLeaves& leavesOf);

/// The mean of the joined pixels that count; of all where none does.
CameraStack joined(const CameraStack& values, const Rasters& cameras, const CameraMask& counts, int levels);

/// 1 where at least half of the joined pixels have 1.
CameraMask joined(const CameraMask& mask, const Rasters& cameras, int levels);

/// A whole acquisition likewise; variances are those of the means. A joined pixel is flagged where half of
/// its pixels are. The tests of it, and what it cost, are left out.
Acquisition coarsened(const Acquisition& acquisition, const Coarsening& coarsening);

}  // namespace relucent::transport
