// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/pipeline/night_alarm.h"
#include "relucent/pipeline/perfect.h"
#include "relucent/pipeline/rig_settings.h"
#include "relucent/rig/rig.h"

namespace relucent::pipeline {

struct NightSettings {
  std::vector<std::filesystem::path> images;  // stills of the show; the first that can be read is proved
  compensation::ContentCanvas canvas;         // that the show puts them on
  int photographs = 6;                        // of each still at most, before the last two
  std::optional<RigSettings> rig;             // none: the calibration's own; others must have its sizes
  std::string alarmCommand{};                 // tells of an alarm, see closeNight(); empty: nobody is told
  std::string set{};                          // as which stills are shown, see sets.h; empty: the one in use
  std::string when{};                         // as its record has it, see utcText(); empty: now
};
std::vector<Message> problems(const NightSettings& settings);

/// What a venue does by itself between two shows: the calibration is made to fit what has become of it
/// (repair.h), stills that are not perfected as they are shown now are (perfect.h), and one is proved by
/// photograph as a show has it (prove.h), into `night` of the calibration. One line of its history tells what
/// came of it. What cannot be done, because of devices, the disk or pictures that cannot be read, is an alarm
/// of that night and no failure: the calibration is then as the last step that was finished left it.
/// Throws: as CalibrationFolder::open(); Error{input} if the calibration is not finished or was imported;
/// Error{disk} if not even the history can be written; Cancelled, and then there is no line.
NightRecord tendCalibration(const std::filesystem::path& folder, const NightSettings& settings,
                            const std::filesystem::path& cache, Progress& progress);
/// The same with devices that somebody has open already.
NightRecord tendCalibration(const std::filesystem::path& folder, const NightSettings& settings, rig::Rig& rig,
                            Progress& progress);

}  // namespace relucent::pipeline
