// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "relucent/photography/references.h"
#include "relucent/sentinels/observer.h"

namespace relucent::sentinels {

/// The picture that is repeated to see whether anything has changed: random blocks in red, the left half in
/// green, the upper half in blue. Its blocks tell shifts, its halves tell which way round it appears.
Stack referencePattern(const Rasters& projectors);
/// The same on one projector, the others dark.
Stack referencePattern(const Rasters& projectors, std::size_t projector);

/// What two photographs say, black and the reference picture, taken one after the other.
struct Check {
  hdr::HdrFrame black;
  hdr::HdrFrame light;  // the reference picture less black
};

/// What a check is compared with.
struct Baseline {
  const photography::References& references;
  const hdr::HdrFrame& black;  // e as it was followed so far
  const Check& first;          // its light that of a later check whose view was accepted
  double power = 1.0;          // of the lamp, continued from the checks before
};

/// Total light of a check relative to the first one.
double lampPower(const Check& now, const Check& first, const photography::References& references);

/// A check in numbers, its shot, flicker and alarm left open: as inspect() compares them.
Reading readingOf(const Check& now, const Baseline& baseline);

/// Compares a check with what is expected. The most fundamental finding only.
std::optional<Alarm> inspect(const Check& now, const Baseline& baseline);

/// Whether the reference picture on one projector appears at all, and the right way round. Its colours are
/// unmixed per camera pixel by the floods; the halves' centres of light span a frame, whose handedness tells.
std::optional<Alarm> inspectOrientation(const hdr::HdrFrame& light, std::size_t projector,
                                        const photography::References& references, bool mayBeMirrored);

}  // namespace relucent::sentinels
