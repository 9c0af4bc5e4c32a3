// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/compensation/methods.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/judge.h"

namespace relucent::pipeline {

/// What masks cost and do by a method, against the same picture without them, by the venue's true light. The
/// masked pixels are those of the target; the picture elsewhere is where no mask takes anything, nor where it
/// comes back within a spot of a projector pixel, and what both targets reach. `asked`: with masks. Throws:
/// Cancelled; as fitTarget().
MaskScore maskScore(const compensation::Compensator& compensator, const Judge& judge,
                    compensation::Method method, const image::Image& content,
                    const compensation::TargetSettings& asked, Progress& progress);

}  // namespace relucent::pipeline
