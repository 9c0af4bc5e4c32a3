// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/pipeline/prove.h"
#include "relucent/pipeline/repair.h"

namespace relucent::pipeline {

/// What one night came to, for whoever looks at weeks of them.
struct NightRecord {
  std::string when;                 // ISO 8601, UTC
  std::optional<RepairEnd> repair;  // none: it failed
  std::vector<Message> what;        // had changed
  int perfected = 0;                // pictures that became better
  std::optional<PictureError> measured,
      predicted;  // of a corrected picture by photograph; none: there is none
  Message alarm;  // why somebody has to look; empty: nobody has to
  double seconds = 0.0;
  Message skipped{};         // why nothing was done though it was time for it; empty: it was done
  bool ofPerfected = false;  // the measured picture was perfected
  bool told = false;         // the alarm, by a command: in this night, or in one before it
  Message untold{};          // why the command could not
};

/// Lines of JSON in the calibration's folder, a night each, oldest first.
inline constexpr const char* nightsName = "nights.jsonl";
/// The oldest are dropped beyond so many: three years.
inline constexpr std::size_t mostNights = 1100;

/// Adds one, atomically. A file that cannot be read is set aside as nights.jsonl.unreadable: a damaged
/// history is no reason to stop. Throws: Error{disk}.
void addNight(const std::filesystem::path& calibration, const NightRecord& night);

/// None where there is none. Throws: Error{disk, format} if it cannot be read.
std::vector<NightRecord> nightsOf(const std::filesystem::path& calibration);

}  // namespace relucent::pipeline
