// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/importing/sequences.h"

namespace relucent::importing {

/// Where a camera pixel's light comes from, as its sequence says.
struct Decoded {
  std::int32_t pixel = -1;   // projector pixel; -1: none
  float correlation = 0.0f;  // 0 to 1: root of the share of the sequence's variation that it explains
  float x = 0.0f, y = 0.0f;  // where its centre is sought from, projector pixels; see agreement.h
};

/// What places are sought for, and in what.
struct DecodingInput {
  const SequencePyramid& pyramid;  // of the patterns
  const PictureSequence& photographs;
  const ImportFrames& frames;
};

/// The projector pixel whose sequence explains most of a camera pixel's,
///   correlation^2 = sum over channels of max(0, z . p)^2 / |p|^2  /  |z|^2,   z, p centred,
/// whatever the patterns are: nothing is thresholded into bits, so patterns may be complemented, in any order
/// or missing. Coarse to fine over the pyramid: all nodes of its coarsest level, then the children of the
/// `beam` best and the ring around them. Structured light has its meaning at every level: a block's mean is
/// certain where stripes are wide and undecided where they are fine.
std::vector<Decoded> decodePixels(const DecodingInput& input, const std::vector<std::uint32_t>& pixels,
                                  int beam, Progress& progress);

/// Neighbours help each other: a pixel takes the place next to which a neighbour found its own, where that
/// explains its sequence better. Finds what the coarse levels cannot tell:
/// patterns without wide structures.  Source: PatchMatch, Barnes et al. 2009.
void propagate(const DecodingInput& input, const CameraMask& lit, std::vector<Decoded>& decoded,
               Progress& progress);

}  // namespace relucent::importing
