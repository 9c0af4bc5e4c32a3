// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/transport/transport_matrix.h"

namespace relucent::engine {

/// A transport matrix with the structure of measured ones: a footprint of 4x4 projector pixels per camera
/// pixel, and three dozen coarse leaves of indirect light. 16 million leaves at the full scale of 1024x768 /
/// 640x480. Deterministic.
transport::TransportMatrix benchTransport(Size projector, Size camera);

/// The same with several projectors side by side, whose pictures overlap by a quarter, and several cameras,
/// each of which sees all of it.  Contract: projectors of one size.
transport::TransportMatrix benchTransport(const Rasters& projectors, const Rasters& cameras);

}  // namespace relucent::engine
