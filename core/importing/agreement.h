// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/importing/decoding.h"

namespace relucent::importing {

/// Where patterns cannot tell neighbouring places apart, camera pixels do so together, as surfaces are
/// smooth. A plane (x, y of the place over the camera's pixels) is fitted to the middles of the sets of
/// places that neighbours cannot tell apart, by least squares and once more without outliers; of its own set
/// a pixel takes the place nearest to it, and its centre is sought from there. Places that the patterns tell
/// apart stay as they are.
void agreeOnPlaces(const SequencePyramid& pyramid, Size camera, std::vector<Decoded>& decoded);

}  // namespace relucent::importing
