// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "calibration/json.h"
#include "devices/device_list.h"

namespace relucent {

/// {"support": [{"kind", "available", "sentence"}],
///  "cameras": [{"address", "model", "usable", then "problem" or "size": [w, h], "format", "bits",
///               "exposures": [shortest, longest], "gain", "software_trigger", "remarks"}]}
Json toJson(const DeviceList& devices);

/// The same for people.
std::string textOf(const DeviceList& devices);

}  // namespace relucent
