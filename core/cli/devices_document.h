// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "calibration/json.h"
#include "devices/camera_registry.h"
#include "pipeline/check.h"

namespace relucent {

/// {"support": [{"kind", "available", "sentence"}],
///  "cameras": [{"address", "model", "usable", then "problem" or "size": [w, h], "format", "bits",
///               "exposures": [shortest, longest], "gain", "software_trigger", "remarks"}]}
Json toJson(const CameraList& devices);

/// The same for people.
std::string textOf(const CameraList& devices);

/// {"latency_frames", "latency_seconds", "step", "flicker", "verdicts",
///  "screen": {"seen", "share", "late", "mirrored"},
///  "light": {"unsteady", "brief_exposure", "flicker", "colours", "bands", "dither"}}
Json toJson(const RigCheck& check);
std::string textOf(const RigCheck& check);

}  // namespace relucent
