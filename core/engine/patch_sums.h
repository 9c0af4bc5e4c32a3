// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/engine/engine_kernels.h"
#include "relucent/engine/packed_transport.h"

namespace relucent::engine {

/// Adds the adjoint sums of the patches of T per node, in the order of the patches whichever finishes first.
/// Most nodes belong to only one patch and are written directly to the result; sums of shared nodes are
/// stored per patch until all are done.
class PatchSums {
 public:
  explicit PatchSums(const PackedTransport& transport, std::size_t nodes);

  /// Number of stored sums.
  std::size_t places() const { return placeNode_.size(); }

  /// Adds one patch's sums: sumFloats floats for each of its columns, `stride` floats apart.
  /// Different patches may be added concurrently.
  /// Shapes: sumFloats * nodes `sums`; sumFloats * places() `waiting`.
  void addPatch(std::size_t patch, const float* columns, std::size_t stride, float* sums,
                float* waiting) const noexcept;
  /// After all patches: adds the stored sums to `sums`; nodes in no patch get 0.
  void addStored(const float* waiting, float* sums) const noexcept;

 private:
  struct Run {
    std::uint32_t begin, end;
  };
  /// A range of columns of a patch whose nodes are either all shared or all unshared.
  struct Columns {
    std::uint32_t begin, end;  // of PackedTransport::nodes()
    std::uint32_t place;       // the first one's, or none
  };
  static constexpr std::uint32_t none = 0xffffffffu;

  void shareOut(const PackedTransport& transport, const std::vector<std::uint32_t>& patchesOfNode);

  const std::vector<std::uint32_t>& node_;
  std::vector<TransportPatch> patches_;
  std::vector<std::uint32_t> columnsStart_;  // of a patch's columns: [columnsStart_[p], columnsStart_[p + 1])
  std::vector<Columns> columns_;
  std::vector<std::uint32_t> placeNode_;
  // Per range of nodes, each handled by one thread: the nodes that start at 0, and the stored sums added to
  // them.
  std::vector<std::uint32_t> clearStart_, pieceStart_;
  std::vector<Run> clear_;  // of nodes
  std::vector<Run> piece_;  // of places
};

}  // namespace relucent::engine
