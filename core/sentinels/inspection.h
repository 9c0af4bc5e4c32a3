// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "photography/references.h"
#include "sentinels/observer.h"

namespace relucent {

/// The picture that is repeated to see whether anything has changed: random blocks in red, the left half in
/// green, the upper half in blue. Its blocks tell shifts, its halves tell which way round it appears.
Stack referencePattern(const Rasters& projectors);
/// The same on one projector, the others dark.
Stack referencePattern(const Rasters& projectors, std::size_t projector);

/// What two photographs say, black and the reference picture, taken one after the other.
struct Check {
  HdrFrame black;
  HdrFrame light;  // the reference picture less black
};

/// Total light of a check relative to the first one.
double lampPower(const Check& now, const Check& first, const References& references);

/// A check in numbers, its shot, flicker and alarm left open: as inspect() compares them.
Reading readingOf(const Check& now, const Check& first, const References& references, const Rasters& cameras,
                  double expectedPower);

/// Compares a check with the first one and with what is expected now: e as in `references`, the lamp at
/// `expectedPower`. The most fundamental finding only.
std::optional<Alarm> inspect(const Check& now, const Check& first, const References& references,
                             const Rasters& cameras, double expectedPower);

/// Whether the reference picture on one projector appears at all, and the right way round. Its colours are
/// unmixed per camera pixel by the floods; the halves' centres of light span a frame, whose handedness tells.
std::optional<Alarm> inspectOrientation(const HdrFrame& light, std::size_t projector,
                                        const References& references, const Rasters& cameras,
                                        bool mayBeMirrored);

}  // namespace relucent
