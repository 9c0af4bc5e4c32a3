// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <QString>
#include <chrono>
#include <optional>

#include "output/daily_hours.h"

namespace relucent::gui {

/// When a show's venue is tended every night, in local time.
class NightSchedule {
 public:
  /// A night that could not begin within so long after its time is left out ...
  static constexpr std::chrono::minutes longestDelay{120};
  /// ... and one that takes longer is broken off.
  static constexpr std::chrono::minutes longestNight{360};

  /// `at`: of the day; outside `hours`, if there are hours of play.
  NightSchedule(QTime at, std::optional<DailyHours> hours);

  /// When the last night should have begun, and when the next one will.
  QDateTime dueBefore(const QDateTime& now) const;
  QDateTime dueAfter(const QDateTime& now) const;
  /// Whether the night of `due` may begin now.
  bool mayBegin(const QDateTime& due, const QDateTime& now) const;
  /// Whether the night that began then must end now: the hours of play are there, or it took too long.
  bool mustEnd(const QDateTime& begun, const QDateTime& now) const;

 private:
  bool isDark(const QDateTime& now) const { return !hours_ || !hours_->contain(now.time()); }

  QTime at_;
  std::optional<DailyHours> hours_;
};

/// Of "HH:MM", or of "after": when the hours of play end. None if it is neither, lies within the hours, or
/// there are no hours to be after.
std::optional<QTime> nightTimeFrom(const QString& text, const std::optional<DailyHours>& hours);

}  // namespace relucent::gui
