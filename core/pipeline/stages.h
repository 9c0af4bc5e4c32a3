// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "calibration/calibration_folder.h"
#include "pipeline/calibrate_settings.h"

namespace relucent {

/// Names of the stages in a calibration's manifest and journal.
namespace stage {
inline constexpr const char* linearization = "linearization";
inline constexpr const char* acquisition = "acquisition";
inline constexpr const char* inverse = "inverse";
}  // namespace stage

/// In a manifest's settings: where the projector's screen hangs now, if not where it was measured. No
/// fingerprint knows it.
inline constexpr const char* movedScreen = "screen";

/// What a calibration was asked for, with the screen that it uses now. Throws: Error{format}.
CalibrateSettings settingsOf(const CalibrationFolder& folder);

/// Fingerprints of everything that a stage's result depends on, as the manifest says it: fields that a later
/// version adds leave them as they are. Each includes those of the stages before, so that a changed setting
/// makes all later results stale.
std::string linearizationFingerprint(const CalibrationFolder& folder);
std::string acquisitionFingerprint(const CalibrationFolder& folder);
std::string inverseFingerprint(const CalibrationFolder& folder);

}  // namespace relucent
