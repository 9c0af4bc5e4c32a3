// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/linearization/exposure_choice.h"
#include "relucent/reduction/pixel_use.h"
#include "relucent/reduction/reduction.h"

namespace relucent::reduction {

/// Pixels of a camera that a choice looks at.
inline constexpr std::size_t mostLookedAt = 300000;

/// Of what remains, in pixels, both ways.
inline constexpr int leastSide = 8;

/// White less black, linear, of every stride-th pixel of a camera: at the longest exposure at which hardly
/// anything clips, or the shortest.
image::Image lightOf(const linearization::ExposureChoice& exposures, std::size_t camera,
                     const std::array<hdr::ResponseCurve, 3>& responses, int stride = 1);

/// Whether there is memory for all that is done with cameras of these sizes.
using Fits = std::function<bool(const Rasters& cameras)>;

/// Whether anybody wants to know what is lit of a camera of this size: somebody wants bins, or it has more
/// pixels than all projectors together.
bool needsLook(Size camera, std::size_t projectorPixels, const PixelUse& use);

/// The reduction for a camera whose every stride-th pixel, both ways, sees `light`, white less black, linear:
///  1. what is lit (lit_part.h) and its surroundings;
///  2. bins, the largest for which lit pixels / bin^2 >= 0.75 projector pixels, unless somebody wants others;
///  at
///     least 8 pixels remain both ways.
/// None where nothing is lit, and automatically where more than three quarters of the pixels would remain.
Reduction reductionFor(Size camera, std::size_t projectorPixels, const PixelUse& use,
                       const image::Image& light, int stride = 1);

/// Photographs white and black and chooses a reduction for every camera:
///  1. exposures, as the linearization does (linearization/exposure_choice.h), by every n-th pixel both ways,
///     300 000 at most: samples as they are, so that saturation and noise are those of a sample;
///  2. of a camera that is not linear the response, by random greys;
///  3. the reduction that this asks for, all projectors' pixels together; automatically, bins of the next
///     whole number, of all cameras, as long as these do not fit and can grow (mostBin, 8 pixels both ways);
///  4. with bins, samples that are bright in the dark: full size, twice, at the longest exposure.
/// Cameras that nobody needs to look at stay as they are, if they fit.
/// Some 6 to 10 photographs, 2 more at full size. `seed`: of the greys.
/// Empty if there was nothing to look for. Throws: as chooseExposures(); Cancelled.
std::vector<Reduction> chooseReductions(rig::Rig& rig, const PixelUse& use, std::uint64_t seed,
                                        const Fits& fits, Progress& progress);

/// The same part in bins of the next whole number; none if they cannot grow. `light`, `stride`: as above.
std::optional<Reduction> withLargerBins(const Reduction& reduction, std::size_t projectorPixels,
                                        const image::Image& light, int stride);

/// The samples of two equal photographs in the dark that are brighter than all around them, by eight
/// deviations of their noise and by 0.02: ascending 3 * pixel + channel. None if that is more than one in a
/// hundred: this is light then.
std::vector<std::uint32_t> hotSamples(const image::Image& dark, const image::Image& again);

}  // namespace relucent::reduction
