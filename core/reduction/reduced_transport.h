// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/reduction/reduction.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::reduction {

/// What the cameras' radiance is once they are reduced, one reduction a camera, none: as it is.
/// Shapes: stack of the cameras -> of the reduced ones.
CameraStack reducedRadiance(const CameraStack& radiance, const std::vector<Reduction>& reductions);

/// The light transport that reduced cameras see: the mean over the rows of every bin's pixels. Samples that
/// one channel leaves out count here as well: a row of T has all three.
/// For whoever knows the true T. Shapes: rows of the cameras -> of the reduced ones.
transport::TransportMatrix reducedTransport(const transport::TransportMatrix& transport,
                                            const std::vector<Reduction>& reductions);

}  // namespace relucent::reduction
