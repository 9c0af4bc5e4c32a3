// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/hdr/hdr.h"

namespace relucent::photography {

/// How much the exposures of one shot contradict each other, relative:
///   |sum z_k / t_k : sum z_0 / t_0 - 1|
/// over the pixels that the longer exposure shows well, the largest over all exposures and cameras. Zero
/// where that is within 6 standard deviations of its noise, and where there is one exposure only.
double bracketContradiction(const rig::Shot& shot, const std::vector<hdr::CameraModel>& cameras);

}  // namespace relucent::photography
