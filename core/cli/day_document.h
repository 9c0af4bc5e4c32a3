// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "relucent/calibration/json.h"
#include "relucent/rehearsal/venue_days.h"

namespace relucent::cli {

/// {"days": [{"day", "happened": [{"what", "missed" | null, "seconds"}], "unexpected": [], "night",
///            "resident_bytes", "own_bytes", "handles", "threads", "process", "log_bytes",
///            "calibration_bytes"}],
///  "bounds": [{"what", "found" | null, "most", "held"}], "held", "out" | null, "seconds"}
calibration::Json toJson(const rehearsal::DaysResult& result);

/// The same for people: a line a day, and one a bound.
std::string textOf(const rehearsal::DaysResult& result);

}  // namespace relucent::cli
