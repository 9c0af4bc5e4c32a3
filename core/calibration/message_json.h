// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/message.h"
#include "relucent/calibration/json.h"

// Where the type is, as the library looks for them there.
namespace relucent {

/// A message as {"id", "pattern", "singular" (if it has one), "arguments", "english"}: to be shown in any
/// language by id and pattern, and to be read by people and other programs as it is. Arguments are
/// {"count": 3}, {"label": 2}, {"seconds": 0.25, "significant": 3} and so on by their units,
/// {"size": [1024, 768]}, {"text": "..."}, {"file": "..."}, {"message": {...}}. A plain text is a string.
void to_json(calibration::Json& json, const Message& message);
/// A string, as calibrations of earlier versions hold, is a plain text. So is the English of what this
/// version does not know to fill in. Throws: Json::exception for anything else.
void from_json(const calibration::Json& json, Message& message);

}  // namespace relucent
