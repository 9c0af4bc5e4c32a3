// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/base/raster.h"
#include "relucent/transport/npz.h"

namespace relucent::transport {

/// Devices as an array (devices, 2) of widths and heights.
void addRasters(NpzWriter& writer, const std::string& name, const Rasters& rasters);
/// Throws: Error{format} for none, or of an impossible size.
Rasters readRasters(const NpzReader& reader, const std::string& name);

}  // namespace relucent::transport
