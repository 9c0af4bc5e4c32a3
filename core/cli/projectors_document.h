// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/calibration/json.h"
#include "relucent/pipeline/projector_statuses.h"

namespace relucent::cli {

/// {"projectors": [{"address", "answers", then "problem" or "name", "maker", "model", "serial", "class",
/// "power",
///                  "shutter", "lamps": [{"hours", "lit"}], "filter_hours", "input", "input_name", "signal",
///                  "own_size", "frozen", "errors": [{"part", "level"}], "remarks"}]}
/// What a projector does not tell is null.
calibration::Json toJson(const std::vector<pipeline::ProjectorStatus>& statuses);

/// The same for people.
std::string textOf(const std::vector<pipeline::ProjectorStatus>& statuses);

}  // namespace relucent::cli
