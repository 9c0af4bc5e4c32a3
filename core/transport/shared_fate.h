// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "relucent/transport/leaf_groups.h"
#include "relucent/transport/leaf_row.h"

namespace relucent::transport {

/// What becomes of shared leaves where camera pixels keep some of theirs: shared stays what all that see it
/// keep.
class SharedFate {
 public:
  explicit SharedFate(const LeafGroups& groups) : groups_(groups), fate_(groups.leaves().blocks(), 0) {}

  /// `kept`: marks of the row's leaves. From any thread, each row once.
  void look(const LeafRow& row, const std::vector<std::uint8_t>& kept, std::size_t projectors) {
    row.visitShared(groups_, projectors, [&](std::size_t entry, std::size_t leaf) {
      std::atomic_ref(fate_[leaf])
          .fetch_or(kept[entry] != 0 ? someKeep : someDrop, std::memory_order_relaxed);
    });
  }
  /// A mark for each of the groups' leaves, once all rows are looked at.
  std::vector<std::uint8_t> staying() const {
    std::vector<std::uint8_t> stays(fate_.size());
    for (std::size_t leaf = 0; leaf < stays.size(); ++leaf) stays[leaf] = fate_[leaf] == someKeep ? 1 : 0;
    return stays;
  }

 private:
  static constexpr std::uint8_t someKeep = 1, someDrop = 2;

  const LeafGroups& groups_;
  std::vector<std::uint8_t> fate_;
};

}  // namespace relucent::transport
