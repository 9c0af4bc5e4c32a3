// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace relucent::calibration {

/// JSON whose keys keep the order in which they were written: documents that people read. Declared only:
/// json.h is for the files that read and write documents.
using Json = nlohmann::ordered_json;

}  // namespace relucent::calibration
