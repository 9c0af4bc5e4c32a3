// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "relucent/hdr/hdr.h"
#include "relucent/image/image.h"

namespace relucent::photography {

/// How much the exposures of one shot contradict each other, relative:
///   |sum z_k / t_k : sum z_0 / t_0 - 1|
/// over the pixels that the longer exposure shows well, the largest over all exposures and cameras. Zero
/// where that is within 6 standard deviations of its noise, and where there is one exposure only.
double bracketContradiction(const rig::Shot& shot, const std::vector<hdr::CameraModel>& cameras);

/// The two exposures, one after the other, of one camera that contradict each other most.
struct ContradictoryViews {
  std::size_t camera = 0;
  bool isLongerFirst = true;
  image::Image longer, shorter;         // radiance, colours summed; no more than the longer one can show
  std::vector<std::uint8_t> saturated;  // per pixel: in the longer one, in any colour
};
/// Of a shot of several exposures. None where no exposures contradict each other.
std::optional<ContradictoryViews> contradictoryViews(const rig::Shot& shot,
                                                     const std::vector<hdr::CameraModel>& cameras);

}  // namespace relucent::photography
