// SPDX-License-Identifier: MIT
#pragma once

#include <QTime>
#include <optional>

namespace relucent::gui {

/// The daily hours of a show, in local time. They may extend past midnight.
struct DailyHours {
  QTime from, to;  // excluding `to`

  bool contain(QTime time) const;
  bool operator==(const DailyHours&) const = default;
};

/// Of "HH:MM-HH:MM"; none if invalid, or if both ends are equal.
std::optional<DailyHours> dailyHoursFrom(const QString& text);

}  // namespace relucent::gui
