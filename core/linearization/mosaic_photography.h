// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/linearization/exposure_choice.h"
#include "relucent/linearization/linearization.h"
#include "relucent/linearization/mosaic_photographs.h"

namespace relucent::linearization {

/// Shows the projectors' mosaics:
///  1. of each projector white and each of its lights alone; of all at once one group in white;
///  2. the levels of all projectors in the same photographs, of each projector one for every light, of which
///     one may be full, which tells the lamp's power, from the highest down: with the exposures for flood
///     images, and with those for dim ones as soon as what has been photographed says that all are that dim;
///  3. white and black again.
/// `cameras` as far as they are known; `choice` from chooseExposures(), its photographs thinned;
/// `blackBefore`: black at the exposures for dim light and, for bright rooms, at others as well, thinned.
/// Throws: Error{input} if no camera sees one of a projector's channels.
MosaicPhotographs photographMosaics(rig::ShotTaker& shots, const std::vector<hdr::CameraModel>& cameras,
                                    const ExposureChoice& choice, rig::Shot blackBefore,
                                    const LinearizationSettings& settings, Progress& progress);

}  // namespace relucent::linearization
