// SPDX-License-Identifier: MIT
#include "jobs/time_left.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

namespace relucent::gui {
namespace {

struct Translated {
  Q_DECLARE_TR_FUNCTIONS(Duration)
};

}  // namespace

void TimeLeft::expect(const WorkLeft& left, Moment now) {
  forecast_ = left.seconds;
  since_ = now;
}

void TimeLeft::pause(Moment now) {
  if (!paused_) paused_ = now;
}

void TimeLeft::resume(Moment now) {
  if (paused_ && since_) *since_ += now - *paused_;
  paused_.reset();
}

std::optional<double> TimeLeft::seconds(Moment now) const {
  if (!since_) return std::nullopt;
  std::chrono::duration<double> passed = paused_.value_or(now) - *since_;
  return std::max(0.0, forecast_ - passed.count());
}

QString durationText(double seconds) {
  constexpr double minute = 60.0, hour = 3600.0;
  if (seconds < minute - 10.0)
    return Translated::tr("%1 s").arg(std::max(10, static_cast<int>(std::ceil(seconds / 10.0)) * 10));
  int minutes = static_cast<int>(std::ceil(seconds / minute));
  if (seconds <= hour) return Translated::tr("%1 min").arg(minutes);
  return Translated::tr("%1 h %2 min").arg(minutes / 60).arg(minutes % 60);
}

}  // namespace relucent::gui
