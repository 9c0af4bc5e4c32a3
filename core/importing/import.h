// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "acquisition/acquisition.h"
#include "base/progress.h"
#include "importing/picture_sequence.h"

namespace relucent {

struct ImportSettings {
  int holdOutEvery = 5;  // every so manieth pattern, ordered by fineness, takes no part in the fit
  int beam = 8;          // places that the search keeps at each level
  bool refit = true;     // once the held-out patterns are predicted, T is fitted to all patterns
};
std::vector<std::string> problems(const ImportSettings& settings);

/// Normalised root mean square error of predictions on held-out patterns,
///   sqrt( sum (photograph - prediction)^2 / sum (photograph - its mean)^2 ),
/// both sums over lit camera pixels, channels and held-out patterns; the mean is each pixel's and channel's
/// over the held-out patterns. Lit: a pixel's grey value spans over the fitted photographs at least a tenth
/// of what 95 % of all pixels' spans stay below. Every prediction was fitted to the same fitted photographs.
struct HeldOutError {
  double oneToOne = 0.0;   // e + gain * the decoded projector pixel, one gain a channel
  double mix = 0.0;        // e + 3x3 * the decoded projector pixel
  double transport = 0.0;  // e + T p
};

struct Import {
  Linearization linearization;  // the projector's estimated response, a linear camera
  Acquisition acquisition;      // one photograph counts as one second of exposure
  std::vector<int> heldOut;     // indices of the patterns that took no part in the fit that predicted them
  HeldOutError error;           // of that fit; T, fitted to all of them, is hardly worse
};

/// The patterns that are held out: of those that are not even all over, ordered by how fine they are (mean
/// difference between neighbouring pixels), one of every `every`, so that all stripe widths have their turn:
/// the middle one, or another of its group where the rest could not tell places apart without that one, or
/// else one of a finer group. Equal patterns and negatives of each other count as one: they say the same, so
/// that all of them are held out or none.
std::vector<int> heldOutPatterns(const PictureSequence& patterns, int every);

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

}  // namespace relucent
