// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "relucent/mapping/projector_maps.h"

namespace relucent::mapping {

/// Writes VESA's interchange format for media servers, profile 2d: an archive of mpcdi.xml, and for each
/// projector, a region that shows the whole content,
///   geometry warp   u_j as a portable float map, (0, 0) the content's upper left corner
///   alpha map       alpha_j as a PNG of 16 bits and three channels, linear (gammaEmbedded 1)
/// Atomically. `date`: as 2026-01-31 12:00:00. Throws: Error{disk}.
/// Source: core/mapping/README.md.
void writeMpcdi(const std::filesystem::path& path, const ProjectorMaps& maps, Size canvas,
                const std::string& date);

}  // namespace relucent::mapping
