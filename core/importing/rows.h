// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/importing/colour.h"
#include "relucent/importing/spread.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::importing {

/// T of an import: row i holds its footprint's shares times its block of colours, and far light in the root;
/// a row without a footprint holds its block in the root alone, light from everywhere. Shapes: one footprint
/// and one colour for each camera pixel.
transport::TransportMatrix importedTransport(const std::vector<Footprint>& footprints,
                                             const LargeVector<PixelColour>& colours, Size projector,
                                             Size camera);

}  // namespace relucent::importing
