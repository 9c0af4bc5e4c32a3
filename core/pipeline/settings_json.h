// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/calibration/json_fwd.h"
#include "relucent/pipeline/calibrate_settings.h"
#include "relucent/reduction/reduction.h"

namespace relucent::pipeline {

/// Settings as the calibration's manifest keeps them. Unknown keys are ignored and missing ones keep their
/// defaults, so that manifests of other versions open.
calibration::Json rigToJson(const RigSettings& settings);
/// Throws: Error{format} if the manifest names a kind of rig that this version does not know.
RigSettings rigFromJson(const calibration::Json& json);

/// Where a screen hangs that was measured elsewhere: display and frame rate.
calibration::Json screenToJson(const ScreenRigSettings::Screen& screen);
/// Puts them in place of those that were measured. Throws: Error{format}.
void screenFromJson(const calibration::Json& json, ScreenRigSettings::Screen& screen);

/// Commands that reach the devices which others reached before. Throws: Error{format}.
calibration::Json commandsToJson(const std::vector<std::string>& commands);
std::vector<std::string> commandsFromJson(const calibration::Json& json);

calibration::Json stagesToJson(const CalibrateSettings& settings);
/// Fills in the stage settings; the rig is left alone. Throws: Error{format}.
void stagesFromJson(const calibration::Json& json, CalibrateSettings& settings);

/// What is shown and how, alone.
calibration::Json contentToJson(const ContentSettings& content);
/// Throws: Error{format}.
ContentSettings contentFromJson(const calibration::Json& json);

/// How the cameras are reduced, one object a camera.
calibration::Json reductionsToJson(const std::vector<reduction::Reduction>& reductions);
/// Throws: Error{format}, also for what reductionTo() would never make.
std::vector<reduction::Reduction> reductionsFromJson(const calibration::Json& json);

}  // namespace relucent::pipeline
