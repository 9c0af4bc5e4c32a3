// SPDX-License-Identifier: MIT
#pragma once

#include "transport/transport_matrix.h"

namespace relucent {

/// A transport matrix of the shape that measured venues have: a footprint of 4x4 projector pixels a camera
/// pixel, and three dozen coarse leaves of light that comes from elsewhere. 16 million leaves at the full
/// scale of 1024x768 / 640x480. The same every time.
TransportMatrix benchTransport(Size projector, Size camera);

}  // namespace relucent
