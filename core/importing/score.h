// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/importing/colour.h"
#include "relucent/importing/held_out.h"
#include "relucent/transport/acquisition.h"

namespace relucent::importing {

/// Predictions of the simpler models, and what all are judged by.
struct HeldOutInput {
  const PictureSequence& patterns;
  const PictureSequence& photographs;
  const ImportFrames& frames;
  const CameraMask& lit;
  const std::vector<Decoded>& decoded;
  const LargeVector<PixelColour>& oneToOne;
  const LargeVector<PixelColour>& mix;
};

struct HeldOutScore {
  HeldOutError error;
  double relative = 0.0;  // of T: root of the residuals' over the photographs' energy less e, lit pixels
};

/// Predicts every held-out photograph with each model.  Same bits for every number of threads.
HeldOutScore scoreHeldOut(const HeldOutInput& input, const transport::Acquisition& acquisition,
                          const DriveTable& drive, Progress& progress);

}  // namespace relucent::importing
