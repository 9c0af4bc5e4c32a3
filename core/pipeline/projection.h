// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/base/raster.h"
#include "relucent/image/image.h"
#include "relucent/linearization/linearization.h"

namespace relucent::pipeline {

/// The drive values that make the projectors emit a linear stack: per projector, through its response.
std::vector<image::Image> encodedDrive(const ProjectorStack& linear, const Rasters& projectors,
                                       const linearization::Linearization& linearization);

/// The same, as it is sent: drive values have the codes of 8 bits.
std::vector<image::Image> codedDrive(const ProjectorStack& linear, const Rasters& projectors,
                                     const linearization::Linearization& linearization);

/// What the projectors emit of drive values.
ProjectorStack lightOf(const std::vector<image::Image>& drive, const Rasters& projectors,
                       const linearization::Linearization& linearization);

/// Content brought to every projector's size and stacked: a pattern for relighting.
Stack patternFrom(const image::Image& linearContent, const Rasters& projectors);

}  // namespace relucent::pipeline
