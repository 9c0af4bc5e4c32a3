// SPDX-License-Identifier: MIT
#pragma once

#include "acquisition/photographer.h"
#include "acquisition/references.h"
#include "transport/transport_matrix.h"

namespace relucent {

/// How well T predicts photographs that it was not made from.
struct Verification {
  double error = 0.0;                 // |measured - predicted| / |measured - e| over all usable pixels
  std::vector<std::uint8_t> flagged;  // per camera pixel: wrong both relatively and beyond its noise
};

/// Photographs random binary patterns of blocks of 1, 2, 4 and 8 pixels, every channel of every block lit or
/// not by chance, and compares them with T p + e.
Verification verify(const TransportMatrix& transport, Photographer& photographer,
                    const References& references, const AcquisitionSettings& settings, Progress& progress);

/// The pattern `number` of those: a projector stack of zeros and ones.
Stack verificationPattern(const Rasters& projectors, int number, std::uint64_t seed);

}  // namespace relucent
