// SPDX-License-Identifier: MIT
#pragma once

#include <QTime>
#include <optional>

namespace relucent {

/// The hours of a day in which a show plays, by the clock on the wall. They may reach over midnight.
struct DailyHours {
  QTime from, to;  // `to` itself no more

  bool contain(QTime time) const;
  bool operator==(const DailyHours&) const = default;
};

/// Of "HH:MM-HH:MM"; none if it is not that, or if both ends are the same.
std::optional<DailyHours> dailyHoursFrom(const QString& text);

}  // namespace relucent
