// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/packed_transport.h"

namespace relucent {

/// Adds up what the patches of T send back to the nodes, in the order of the patches whoever is done first.
/// Most nodes belong to one patch alone and are written once, where they are wanted; what several patches
/// share waits in a place of the patch's own.
class PatchSums {
 public:
  explicit PatchSums(const PackedTransport& transport, std::size_t nodes);

  /// Places for what waits, `placeFloats` floats each.
  std::size_t places() const { return placeNode_.size(); }
  static constexpr std::size_t placeFloats = 4;

  /// Hands over one patch's sums: three floats for each of its columns, `stride` floats apart.
  /// Different patches may do so at the same time.
  /// Shapes: 3 * nodes `sums`; placeFloats * places() `waiting`.
  void handOver(std::size_t patch, const float* columns, std::size_t stride, float* sums,
                float* waiting) const noexcept;
  /// When all patches have: adds what waits to `sums`; nodes that no patch knows get 0.
  void addUp(const float* waiting, float* sums) const noexcept;

 private:
  struct Run {
    std::uint32_t begin, end;
  };
  /// Some columns of a patch, all alone in knowing their nodes or none of them.
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
  // By ranges of nodes, each the work of one thread: what must begin at 0, and the places that add to it.
  std::vector<std::uint32_t> clearStart_, pieceStart_;
  std::vector<Run> clear_;  // of nodes
  std::vector<Run> piece_;  // of places
};

}  // namespace relucent
