// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/raster.h"
#include "image/image.h"
#include "linearization/linearization.h"

namespace relucent {

/// The drive values that make the projectors emit a linear stack: per projector, through its response.
std::vector<Image> encodedDrive(const Stack& linear, const Rasters& projectors,
                                const Linearization& linearization);

/// Content brought to every projector's size and stacked: a pattern for relighting.
Stack patternFrom(const Image& linearContent, const Rasters& projectors);

}  // namespace relucent
