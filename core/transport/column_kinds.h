// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "relucent/transport/node_layout.h"

namespace relucent::transport {

/// Which columns of a row share its colours: ranges of columns, and a kind for each. All blocks of a row
/// whose columns are of one kind differ by a factor for each projector channel.
struct ColumnKinds {
  struct Range {
    std::uint32_t end = 0;   // its columns are those from the range before on, up to this one
    std::uint32_t kind = 0;  // several ranges may be of one kind
    bool operator==(const Range&) const = default;
  };
  std::vector<Range> ranges;  // ascending; the last ends at the number of columns
  std::size_t count = 0;      // of kinds

  std::uint32_t kindOf(std::uint32_t column) const {
    return std::ranges::upper_bound(ranges, column, {}, &Range::end)->kind;
  }
  bool operator==(const ColumnKinds&) const = default;
};

/// Near and far light of every projector, kinds 2 * projector and 2 * projector + 1: light of its
/// `nearLevels` finest levels comes straight from it, that of wider nodes by way of other surfaces, with
/// their colours.
ColumnKinds nearAndFar(const NodeLayout& layout, int nearLevels);
constexpr std::size_t nearKind(std::size_t projector) {
  return 2 * projector;
}
constexpr std::size_t farKind(std::size_t projector) {
  return 2 * projector + 1;
}

}  // namespace relucent::transport
