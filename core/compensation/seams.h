// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "relucent/compensation/direct_light.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::compensation {

/// Pairs of camera pixels across the edges of the projectors' pictures: `apart` pixels from each other, along
/// x or y, both of the mask, lit directly by different sets of projectors.
struct SeamPairs {
  std::vector<std::array<std::size_t, 2>> across;     // rows of T; each edge from the same side
  std::vector<std::size_t> stretch;                   // of an edge, eight pixels long: of every pair across
  std::vector<std::array<std::size_t, 2>> elsewhere;  // as far apart, lit by the same projectors
};
/// Beyond the blur of an edge, and near enough to be compared.
inline constexpr int seamApart = 3;
SeamPairs seamPairs(const transport::TransportMatrix& transport, const CameraMask& mask, int apart,
                    const DirectLightSettings& settings);

/// What is seen of seams where one flat grey is wanted: CIEDE2000 between the two pixels of a pair, each the
/// mean of it and its neighbours within the mask, as a viewer sees them who is adapted to `white`.
struct Seams {
  double mean = 0.0, p95 = 0.0;  // across the edges of projectors' pictures; NaN: there are none
  double elsewhere = 0.0;        // mean beside them: what is uneven without any seam
  double elsewhereP95 = 0.0;
  /// The seam alone, 95 % of the pairs across: the same between the means of L*a*b* along a stretch of the
  /// edge on either side, in which what is uneven otherwise averages out.
  double edgeP95 = 0.0;
};
Seams seamsOf(const CameraStack& seen, const Rasters& cameras, const CameraMask& mask,
              const std::array<float, 3>& white, const SeamPairs& pairs);

}  // namespace relucent::compensation
