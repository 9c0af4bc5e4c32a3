// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/pipeline/calibrate_settings.h"

namespace relucent::report {

/// A line of a table: what it is called and what it says, in words and units.
struct NamedText {
  std::string name;
  std::string value;
};

/// With which devices and how the venue was measured, and how pictures are placed. What no client would miss,
/// the manifest keeps alone.
std::vector<NamedText> settingsInWords(const pipeline::CalibrateSettings& settings);

}  // namespace relucent::report
