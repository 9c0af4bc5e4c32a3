// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "relucent/image/exr.h"
#include "relucent/image/image.h"

namespace relucent::image {

/// "flood-1.exr": the file of the first device's part of a stack.
std::string stackFileName(const std::string& name, std::size_t device);

/// Writes a stack as float OpenEXR, one file per device, atomically each.
/// Throws: as writeExr().
std::vector<std::filesystem::path> writeStack(const std::filesystem::path& folder, const std::string& name,
                                              const Stack& stack, const Rasters& rasters,
                                              const std::string& units, ExrPacking packing = ExrPacking::zip);

/// Flags as a stack: 0, or 1 in all three channels.
Stack stackFromFlags(const std::vector<std::uint8_t>& flags);

}  // namespace relucent::image
