// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/inverse/near_field.h"
#include "relucent/inverse/windows.h"

namespace relucent::inverse {

/// The camera pixels of every window, ascending: neighbours in memory when the window is applied.
struct WindowRows {
  std::vector<std::size_t> start;  // window of tile t: [start[t], start[t + 1])
  std::vector<std::uint32_t> row;
};

/// For every tile of projector pixels the `settings.rows` camera pixels whose near fields have most light in
/// it. `tiles`: their grid on each projector.
WindowRows chooseWindowRows(const NearField& near, const transport::NodeLayout& layout, const Rasters& tiles,
                            const WindowSettings& settings);

}  // namespace relucent::inverse
