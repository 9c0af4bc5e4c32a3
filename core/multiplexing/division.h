// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/multiplexing/rows.h"

namespace relucent::multiplexing {

struct DivisionSettings {
  float sigmas = 2.0f;      // light below so many deviations is not followed
  float neighbours = 1.5f;  // but where the four neighbours' mean is above so many thresholds
  float joined = 2.0f;      // siblings whose light together is below so many thresholds are one leaf again
};

/// Divides the leaves of `level` whose light is above their row's threshold and its own noise, or that the
/// neighbouring camera pixels divide. Siblings of that level that prove to have been divided in vain are
/// joined. Children share the light by their areas, with a spread that allows most of it to be in one of
/// them. Shapes: a row and a threshold, relative to F_c, for each camera pixel; rows without leaves take no
/// part.
void divide(Rows& rows, const Rasters& cameras, const transport::NodeLayout& layout, int level,
            const std::vector<float>& thresholds, const DivisionSettings& settings);

/// How many leaves of the next finer level each row would have then.
[[nodiscard]] std::vector<std::size_t> childrenAfterDivision(const Rows& rows, const Rasters& cameras,
                                                             const transport::NodeLayout& layout, int level,
                                                             const std::vector<float>& thresholds,
                                                             const DivisionSettings& settings);

}  // namespace relucent::multiplexing
