// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/importing/held_out.h"
#include "relucent/linearization/linearization.h"
#include "relucent/transport/acquisition.h"

namespace relucent::importing {

struct ImportSettings {
  int holdOutEvery = 5;  // every so manieth pattern, ordered by fineness, takes no part in the fit
  int beam = 8;          // places that the search keeps at each level
  bool refit = true;     // once the held-out patterns are predicted, T is fitted to all patterns
};
std::vector<Message> problems(const ImportSettings& settings);

struct Import {
  linearization::Linearization linearization;  // the projector's estimated response, a linear camera
  transport::Acquisition acquisition;          // one photograph counts as one second of exposure
  std::vector<int> heldOut;  // indices of the patterns that took no part in the fit that predicted them
  HeldOutError error;        // of that fit; T, fitted to all of them, is hardly worse
};

/// Estimates T from patterns and photographs of them that were taken elsewhere. `patterns` holds encoded
/// drive, `photographs` linear signals; picture k of one belongs to picture k of the other.
///  1. Hold out patterns; they are not looked at before step 6.
///  2. Decode: the projector pixel whose sequence correlates best with a camera pixel's, coarse to fine.
///  3. Spread: a Gaussian footprint a camera pixel, its centre and widths by damped least squares.
///  4. Response and colour, in turns with 3 on a sample of pixels: a curve for each projector channel where
///     the patterns have levels between black and white, and one 3x3 mixing.
///  5. Every camera pixel: black e and its own 3x3 block, held to the common mixing where the patterns are
///     silent.
///  6. Predict the held-out photographs.
///  7. If wanted, steps 2 to 5 once more with all patterns: what is held out is the finest stripes above all,
///     which T had better know.
/// Source: core/importing/README.md.
/// Throws: Error{input} if the patterns are too few to tell places apart or no camera pixel reacts to them;
/// Cancelled.
Import importTransport(const PictureSequence& patterns, const PictureSequence& photographs,
                       const ImportSettings& settings, Progress& progress);

}  // namespace relucent::importing
