// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "relucent/hdr/hdr.h"
#include "relucent/image/image.h"
#include "relucent/sentinels/movement.h"

namespace relucent::pipeline {

/// Where a camera looks, compared with where it looked when the venue was measured.
struct AimOffset {
  sentinels::Movement movement;  // of what is seen
  double apart = 0.0;            // relative difference of both pictures, as they are
  /// The movement is all that differs, or hardly anything does. Otherwise it says nothing: something else
  /// is in the view, or another light.
  bool isRecognised = false;
  double gain = 0.0;  // how many times as bright as expected it is; 0: one of them shows nothing
};

/// The pixels of one camera's view of which T tells and that `seen` did not saturate, for aimOffset().
std::vector<std::uint8_t> comparedPixels(const CameraMask& usable, const hdr::HdrFrame& seen,
                                         const Rasters& cameras, std::size_t camera);

/// `expected` and `seen`: three channels, the same size, in any units: their mean brightness is made equal.
/// Views of more than 640 pixels are compared at that size, which finds 0.1 pixel of a 4K camera.
/// `saturation`: of `seen`, where it ends. `compared`: pixels that say something in both, 0 elsewhere; empty:
/// all do. Throws: require() of the sizes.
AimOffset aimOffset(const image::Image& expected, const image::Image& seen,
                    float saturation = std::numeric_limits<float>::infinity(),
                    const std::vector<std::uint8_t>& compared = {});

}  // namespace relucent::pipeline
