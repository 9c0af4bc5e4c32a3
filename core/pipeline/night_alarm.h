// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "relucent/pipeline/night_record.h"

namespace relucent::pipeline {

/// Whether somebody has to look in the morning.
inline bool isAlarm(const NightRecord& night) {
  return !night.alarm.empty();
}

/// Whether two sentences say the same of the same thing: figures in them may differ, names may not.
bool saysTheSame(const Message& a, const Message& b);

/// Ends a night: tells its alarm, and adds its line to the history (addNight()).
/// `command`: for /bin/sh, by whoever runs the night, never out of a calibration; {sentence} becomes why in
/// English, {calibration} the folder, each quoted. Empty: none. It is run unless the last night that was not
/// skipped told of the same, and again in the next night if it fails; night.told and night.untold say so.
/// Throws: Error{disk} if the history cannot be written; the alarm is told then, too.
void closeNight(const std::filesystem::path& calibration, NightRecord& night, const std::string& command);

}  // namespace relucent::pipeline
