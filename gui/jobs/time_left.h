// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <chrono>
#include <optional>

#include "relucent/base/progress.h"

namespace relucent::gui {

/// Remaining time of a measurement: core's latest forecast, counted down by the clock until the next one.
class TimeLeft {
 public:
  using Moment = std::chrono::steady_clock::time_point;

  void expect(const WorkLeft& left, Moment now);
  void pause(Moment now);
  void resume(Moment now);
  /// None before the first forecast.
  std::optional<double> seconds(Moment now) const;

 private:
  double forecast_ = 0.0;
  std::optional<Moment> since_;
  std::optional<Moment> paused_;
};

/// "40 s", "11 min", "2 h 5 min": rounded up, to 10 s below a minute and to a minute below an hour.
QString durationText(double seconds);

}  // namespace relucent::gui
