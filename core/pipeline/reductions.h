// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "relucent/acquisition/settings.h"
#include "relucent/base/progress.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/linearization/exposure_choice.h"
#include "relucent/pipeline/calibrate_settings.h"
#include "relucent/platform/memory_limits.h"
#include "relucent/reduction/pixel_use.h"
#include "relucent/reduction/reduction.h"

/// How the cameras of a calibration are reduced: chosen once before anything is measured and kept with it
/// (stored_settings.h).
namespace relucent::pipeline {

/// Chooses reductions as the settings want them and keeps them, unless that is done or something has been
/// measured: photographs of the linearization are in the journal. `memory`: what may be taken; without it,
/// platform::memoryLeft().
/// Throws: as chooseReductions(); Error{memory} if it is too little, before the first photograph if no choice
/// of automatic pixels could change that.
void chooseReductions(calibration::CalibrationFolder& folder, rig::Rig& rig,
                      const platform::MemoryUse& memory, Progress& progress);
void chooseReductions(calibration::CalibrationFolder& folder, rig::Rig& rig, Progress& progress);

/// The settings want other pixels. What was chosen is forgotten, and photographs of linearization and
/// acquisition are set aside: they are of another size. Throws: Error{disk}.
void changePixels(calibration::CalibrationFolder& folder, const reduction::PixelUse& use);

/// Devices as a calibration measures with them; they stay `rig`'s. Throws: as reduced(), reductionsOf().
rig::Rig reducedRig(const calibration::CalibrationFolder& folder, rig::Rig& rig);

/// What a choice of pixels comes to.
struct PixelForecast {
  reduction::PixelUse use;
  Size camera;    // all that it delivers
  Size used;      // what is made of them
  WorkLeft work;  // of measuring the light transport with these
};

/// Of the first camera: automatic, all, and bins of 2 to 4, by the photographs that chose the exposures and
/// what they took; automatic as far as `memory` goes. Empty for a camera with no more pixels than the
/// projectors. Of a camera that is not linear more seems to be lit than is, so that this is rather too much.
std::vector<PixelForecast> pixelForecasts(const rig::Rig& rig, const linearization::ExposureChoice& exposures,
                                          const rig::ShotTimes& took,
                                          const acquisition::AcquisitionSettings& settings,
                                          const platform::MemoryUse& memory);

/// What is made of the pixels of every camera that is reduced, a sentence each.
std::vector<Message> findingsOf(const std::vector<reduction::Reduction>& reductions);

}  // namespace relucent::pipeline
