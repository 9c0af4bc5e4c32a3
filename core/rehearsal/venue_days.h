// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "relucent/base/progress.h"
#include "relucent/rehearsal/day_bounds.h"
#include "relucent/rehearsal/day_settings.h"

namespace relucent::rehearsal {

struct DaysResult {
  std::vector<RehearsedDay> days;
  std::vector<Bound> bounds;
  std::filesystem::path out;
  double seconds = 0.0;
};
bool allHeld(const DaysResult& result);

/// Rehearses a venue's days around the real program `relucent show`, day after day from 08:50 on:
///   1. 09:00 the hours begin: projectors are switched on by PJLink and warm up, content plays (a still, and
///   a
///      live picture from the network).
///   2. 10:00 memory, handles and threads of the show are looked at.
///   3. 11:00 the live picture is lost and comes back; 12:00 the still is gone for an hour; 14:00 the power
///      fails, and the show is started again as its service does; 16:00 a projector leaves the network for a
///      while. 18:00 the hours end, and projectors are switched off.
///   4. 20:00 the night: projectors on, their light waited for, the calibration tended, off again; the power
///   may
///      fail in the middle, and the still may be one that cannot be read.
/// What happens on which day: happeningsOf(). Within the last two thirds of the days the power does not fail,
/// so that one process has to last. The show's time passes so that a day takes `daySeconds`, slower while
/// something is looked at, and stands still until what belongs to that hour was seen.
/// Throws: as VenueFolder, ShowProcess and the simulated devices; Cancelled.
DaysResult rehearseDays(const DaysSettings& settings, Progress& progress);

/// What is to happen on a day, from 1, of so many, in its order.
std::vector<Happening> happeningsOf(int day, int days);

}  // namespace relucent::rehearsal
