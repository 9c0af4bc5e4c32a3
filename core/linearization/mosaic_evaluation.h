// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/base/progress.h"
#include "relucent/linearization/additivity.h"
#include "relucent/linearization/linearization.h"
#include "relucent/linearization/mosaic_photographs.h"
#include "relucent/linearization/thinning.h"

namespace relucent::linearization {

/// What the photographs say of a projector.
struct MosaicResult {
  ProjectorResponse response;
  Additivity additivity;
  std::vector<double> flicker;  // per camera: of the light between photographs, relative
  double unevenness = 0.0;      // of the response over the picture: the largest deviation of a part, of white
};
/// Per projector. Throws: as fitResponses().
std::vector<MosaicResult> evaluateMosaics(const MosaicPhotographs& photographs,
                                          const std::vector<hdr::CameraModel>& cameras,
                                          const Thinning& thinning, Progress& progress);

}  // namespace relucent::linearization
