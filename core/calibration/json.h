// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace relucent {

/// JSON whose keys keep the order in which they were written: documents that people read.
using Json = nlohmann::ordered_json;

}  // namespace relucent
