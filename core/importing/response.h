// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "relucent/importing/colour.h"

namespace relucent::importing {

/// Drive codes (0 to 255) of a channel that the fitted patterns hold, ascending.
std::vector<int> codesOf(const PictureSequence& patterns, const ImportFrames& frames, int channel);

/// A camera pixel of the sample from which the response is estimated.
struct SamplePixel {
  std::size_t pixel = 0;
  Footprint footprint;
  PixelColour colour;
};

/// The curves r_c that explain a sample's photographs best while footprints and colours stay as they are,
///   signal = e + sum over channels c of B_c * (sum over nodes j of share_j * r_c(drive_jc)),
/// piecewise linear between up to 33 of the codes that the patterns hold, least squares, then isotonic and
/// smooth (curveFromRamp). A channel without codes between black and white keeps its curve.
linearization::ProjectorResponse estimateResponse(const ImportPictures& pictures,
                                                  const std::vector<SamplePixel>& sample,
                                                  const linearization::ProjectorResponse& before);

/// What most projectors do, a power of 2.2; stands where the patterns cannot tell.
hdr::ResponseCurve usualCurve();

}  // namespace relucent::importing
