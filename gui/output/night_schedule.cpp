// SPDX-License-Identifier: MIT
#include "output/night_schedule.h"

namespace relucent::gui {

NightSchedule::NightSchedule(QTime at, std::optional<DailyHours> hours) : at_(at), hours_(hours) {}

QDateTime NightSchedule::dueBefore(const QDateTime& now) const {
  const QDateTime today(now.date(), at_);
  return today <= now ? today : QDateTime(now.date().addDays(-1), at_);
}

QDateTime NightSchedule::dueAfter(const QDateTime& now) const {
  return {dueBefore(now).date().addDays(1), at_};
}

bool NightSchedule::mayBegin(const QDateTime& due, const QDateTime& now) const {
  return due <= now && due.secsTo(now) < std::chrono::seconds(longestDelay).count() && isDark(now);
}

bool NightSchedule::mustEnd(const QDateTime& begun, const QDateTime& now) const {
  return !isDark(now) || begun.secsTo(now) >= std::chrono::seconds(longestNight).count();
}

std::optional<QTime> nightTimeFrom(const QString& text, const std::optional<DailyHours>& hours) {
  if (text == "after") return hours ? std::optional(hours->to) : std::nullopt;
  const QTime time = QTime::fromString(text.trimmed(), "H:mm");
  if (!time.isValid() || (hours && hours->contain(time))) return std::nullopt;
  return time;
}

}  // namespace relucent::gui
