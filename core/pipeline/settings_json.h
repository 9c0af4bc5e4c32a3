// SPDX-License-Identifier: MIT
#pragma once

#include "calibration/json_fwd.h"
#include "pipeline/calibrate_settings.h"

namespace relucent {

/// Settings as the calibration's manifest keeps them. Unknown keys are ignored and missing ones keep their
/// defaults, so that manifests of other versions open.
Json rigToJson(const RigSettings& settings);
/// Throws: Error{format} if the manifest names a kind of rig that this version does not know.
RigSettings rigFromJson(const Json& json);

/// Where a screen hangs that was measured elsewhere: display and frame rate.
Json screenToJson(const ScreenRigSettings& settings);
/// Puts them in place of those that were measured. Throws: Error{format}.
void screenFromJson(const Json& json, ScreenRigSettings& settings);

Json stagesToJson(const CalibrateSettings& settings);
/// Fills in the stage settings; the rig is left alone. Throws: Error{format}.
void stagesFromJson(const Json& json, CalibrateSettings& settings);

}  // namespace relucent
