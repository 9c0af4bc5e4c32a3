// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/calibration/json.h"
#include "relucent/devices/camera_registry.h"
#include "relucent/pipeline/check.h"

namespace relucent::cli {

/// {"support": [{"kind", "available", "sentence"}],
///  "cameras": [{"address", "model", "usable", then "problem" or "size": [w, h], "format", "bits",
///               "exposures": [shortest, longest], "gain", "software_trigger", "remarks"}]}
calibration::Json toJson(const devices::CameraList& devices);

/// The same for people.
std::string textOf(const devices::CameraList& devices);

/// {"latency_frames", "latency_seconds", "step", "flicker", "verdicts",
///  "screen": {"seen", "share", "late", "mirrored"},
///  "light": {"unsteady", "brief_exposure", "flicker", "colours", "bands", "dither"}}
calibration::Json toJson(const pipeline::RigCheck& check);
std::string textOf(const pipeline::RigCheck& check);

}  // namespace relucent::cli
