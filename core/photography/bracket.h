// SPDX-License-Identifier: MIT
#pragma once

#include "hdr/hdr.h"

namespace relucent {

/// How much the exposures of one shot contradict each other, relative:
///   |sum z_k / t_k : sum z_0 / t_0 - 1|
/// over the pixels that the longer exposure shows well, the largest over all exposures and cameras. Zero
/// where that is within 6 standard deviations of its noise, and where there is one exposure only.
double bracketContradiction(const Shot& shot, const std::vector<CameraModel>& cameras);

}  // namespace relucent
