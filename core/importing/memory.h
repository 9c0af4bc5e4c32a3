// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "relucent/base/raster.h"

namespace relucent::importing {

/// What an import takes at most. Bytes.
struct ImportMemory {
  std::uint64_t bytes = 0;
  std::uint64_t mapped = 0;  // of these in LargeVectors: where there is little memory they lie on the disk
};

/// Of importTransport(), the pictures included, for so many patterns and as many photographs, all coloured:
///   sequences   6 pictures (N + M),     pyramid   4/3 N (12 pictures + 12),
///   T           22 leavesOfRow M,       a few hundred bytes more for each camera pixel,
/// N projector and M camera pixels. What is read as they are reduced comes on top.
ImportMemory importMemory(Size projector, Size camera, int pictures);

}  // namespace relucent::importing
