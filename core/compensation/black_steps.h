// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/compensation/seams.h"
#include "relucent/compensation/target.h"

namespace relucent::compensation {

/// What is seen of the edges of projectors' black where black is wanted: light cannot be taken away, so that
/// a pixel has max(e, white lift) at the least.
///   steps(lift) = seamsOf(max(e, white lift)).p95
Seams blackSteps(const MeasuredVenue& venue, const Target& target, const SeamPairs& pairs, double lift);

/// The least black lift with which black steps are not seen: steps(lift) <= CIEDE2000 `seen`, found to a
/// ten-thousandth of white; 0 where nothing is to be seen anyhow, and where even `most` is not enough: then
/// all black would be grey, and the edges would still be there. `target`: of any picture; `pairs`: of
/// seamPairs() within it.
double leastBlackLift(const MeasuredVenue& venue, const Target& target, const SeamPairs& pairs,
                      double seen = 1.0, double most = 0.05);

/// The same for all edges within the target, of pairs `seamApart` pixels apart; 0 of one projector.
double leastBlackLift(const MeasuredVenue& venue, const Target& target);

}  // namespace relucent::compensation
