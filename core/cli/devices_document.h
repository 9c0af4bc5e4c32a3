// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "calibration/json.h"
#include "devices/device_list.h"
#include "devices/latency.h"

namespace relucent {

/// {"support": [{"kind", "available", "sentence"}],
///  "cameras": [{"address", "model", "usable", then "problem" or "size": [w, h], "format", "bits",
///               "exposures": [shortest, longest], "gain", "software_trigger", "remarks"}]}
Json toJson(const DeviceList& devices);

/// The same for people.
std::string textOf(const DeviceList& devices);

/// {"latency_frames", "latency_seconds", "step", "flicker", "verdicts"}
Json toJson(const Latency& latency);
std::string textOf(const Latency& latency);

}  // namespace relucent
