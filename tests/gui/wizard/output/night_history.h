// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <filesystem>

#include "relucent/pipeline/night_record.h"

namespace relucent::gui {

/// Four weeks as a venue may have them: two repairs, a night that was left out, and one where somebody had to
/// look.
inline void addFourWeeks(const std::filesystem::path& calibration) {
  const auto painted = RELUCENT_MESSAGE("repair.surface-changed",
                                        "{} % of what the cameras see is brighter, darker or of another "
                                        "colour than it was")
                           .with(as::share(0.08, as::decimals(1)));
  for (int day = 0; day < 28; ++day) {
    pipeline::NightRecord night;
    night.when = QDateTime({2026, 5, 1}, {2, 0}, Qt::UTC).addDays(day).toString(Qt::ISODate).toStdString();
    night.seconds = 300.0;
    if (day == 19) {
      night.skipped = RELUCENT_MESSAGE("night.hours-began", "the show's hours began before it was done");
    } else if (day == 24) {
      night.alarm =
          RELUCENT_MESSAGE("device.command-failed", "the command failed with status {}").with(as::label(1));
    } else {
      night.repair = pipeline::RepairEnd::nothingToDo;
      night.measured = pipeline::PictureError{30.0 - 0.02 * day, 1.4 + 0.01 * day};
      night.predicted = pipeline::PictureError{31.0, 1.3};
      if (day == 8 || day == 21) {
        night.repair = pipeline::RepairEnd::repaired;
        night.what = {painted};
        night.perfected = 1;
      }
    }
    pipeline::addNight(calibration, night);
  }
}

}  // namespace relucent::gui
