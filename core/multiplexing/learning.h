// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/multiplexing/regression.h"

namespace relucent::multiplexing {

/// What a fit says about the row before it is fitted once more, from the same photographs:
/// - excess: what the residual has beyond the photographs' noise,
///     (noise + excess) misfit - noise;
/// - mixing: that of the near and of the far leaves' own sums, drawn towards the flood's where there is
/// little
///   light to tell it from;
/// - spreads: sqrt(light^2 + deviation^2), about zero; negative light has no right to more than its
/// deviation. `floodMixing`: of every projector, as in Row::mixing. Source: core/multiplexing/README.md;
/// automatic relevance determination, [MAC], [TIP].
void learn(Row& row, const RowFit& fit, const std::vector<transport::ColourBlock>& floodMixing,
           const RowSettings& settings);

}  // namespace relucent::multiplexing
