// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "acquisition/watch.h"
#include "transport/transport_matrix.h"

namespace relucent {

/// Block sizes of the verification patterns, in turn: 1, 2, 4, 8 pixels.
inline constexpr int verificationSizes = 4;

/// Sums over the patterns, of one camera pixel.
struct Residual {
  double squared = 0.0;   // of measured - predicted
  double variance = 0.0;  // expected of that, from noise alone
  double light = 0.0;     // squared, of measured - e

  double relative() const { return light > 0.0 ? std::sqrt(squared / light) : 0.0; }
};

/// |measured - predicted| / |measured - e| over all camera pixels.
double errorOf(const std::vector<Residual>& rows);

/// How well T predicts photographs that it was not made from.
struct Verification {
  std::vector<Residual> rows;         // per camera pixel; zeros where it did not count
  std::vector<std::uint8_t> flagged;  // per camera pixel: wrong both relatively and beyond its noise
  std::vector<Stack> residual;  // per block size: root of the mean square of measured - predicted, radiance
};

/// Photographs random binary patterns of blocks of 1, 2, 4 and 8 pixels, every channel of every block lit or
/// not by chance, and compares them with T p. `rows`: the camera pixels that count. `first`: the number of
/// the first pattern, so that another round sees other patterns. Throws: as Watch::check().
Verification verify(const TransportMatrix& transport, Watch& watch, const References& references,
                    const AcquisitionSettings& settings, const std::vector<std::uint8_t>& rows, int first,
                    Progress& progress);

/// The pattern `number` of those: a projector stack of zeros and ones.
Stack verificationPattern(const Rasters& projectors, int number, std::uint64_t seed);

}  // namespace relucent
