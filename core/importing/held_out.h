// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/importing/picture_sequence.h"

namespace relucent::importing {

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

/// The patterns that are held out: of those that are not even all over, ordered by how fine they are (mean
/// difference between neighbouring pixels), one of every `every`, so that all stripe widths have their turn:
/// the middle one, or another of its group where the rest could not tell places apart without that one, or
/// else one of a finer group. Equal patterns and negatives of each other count as one: they say the same, so
/// that all of them are held out or none.
std::vector<int> heldOutPatterns(const PictureSequence& patterns, int every);

}  // namespace relucent::importing
