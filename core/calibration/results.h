// SPDX-License-Identifier: MIT
#pragma once

#include "calibration/calibration_folder.h"
#include "linearization/linearization.h"
#include "transport/acquisition.h"

namespace relucent {

/// Results of the stages on disk and back, the same bits. `inputs` is the fingerprint of all that the stage
/// was given; `cost` (seconds, patterns, ...) is kept with it as "cost". Storing throws Error{disk}; loading
/// throws Error{format} if a file is missing, damaged or contradicts another.

/// Curves, camera models and findings, all as JSON in the manifest.
StageResult storeLinearization(CalibrationFolder& folder, const std::string& inputs,
                               const Linearization& linearization, const Json& cost);
Linearization loadLinearization(const StageResult& result);

/// transport.npz (the leaves, see transport/files.h), and per camera black, flood, their variances and the
/// flags as OpenEXR; figures and findings as JSON.
StageResult storeAcquisition(CalibrationFolder& folder, const std::string& inputs,
                             const Acquisition& acquisition, const Json& cost);
Acquisition loadAcquisition(const StageResult& result);

}  // namespace relucent
