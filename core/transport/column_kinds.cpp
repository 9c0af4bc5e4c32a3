// SPDX-License-Identifier: MIT
#include "relucent/transport/column_kinds.h"

namespace relucent::transport {

ColumnKinds nearAndFar(const NodeLayout& layout, int nearLevels) {
  const std::size_t projectors = layout.projectors().devices();
  ColumnKinds kinds;
  kinds.count = 2 * projectors;
  std::size_t end = 0;
  for (int level = 0; level < layout.levels(); ++level)
    for (std::size_t projector = 0; projector < projectors; ++projector) {
      if (level >= layout.levels(projector)) continue;
      end += layout.gridSize(projector, level).count();
      const auto kind = static_cast<std::uint32_t>(2 * projector + (level < nearLevels ? 0 : 1));
      if (!kinds.ranges.empty() && kinds.ranges.back().kind == kind)
        kinds.ranges.back().end = static_cast<std::uint32_t>(end);
      else
        kinds.ranges.push_back({static_cast<std::uint32_t>(end), kind});
    }
  return kinds;
}

}  // namespace relucent::transport
