// SPDX-License-Identifier: MIT
#include "output/daily_hours.h"

#include <QStringList>

namespace relucent::gui {

bool DailyHours::contain(QTime time) const {
  return from < to ? time >= from && time < to : time >= from || time < to;
}

std::optional<DailyHours> dailyHoursFrom(const QString& text) {
  QStringList ends = text.split('-');
  if (ends.size() != 2) return std::nullopt;
  DailyHours hours{QTime::fromString(ends[0].trimmed(), "H:mm"),
                   QTime::fromString(ends[1].trimmed(), "H:mm")};
  if (!hours.from.isValid() || !hours.to.isValid() || hours.from == hours.to) return std::nullopt;
  return hours;
}

}  // namespace relucent::gui
