// SPDX-License-Identifier: MIT
#pragma once

#include <QList>
#include <QString>
#include <QTime>
#include <optional>
#include <vector>

#include "relucent/base/message.h"

namespace relucent::gui {

/// As files and people write the time of a set.
inline constexpr const char* setTimeFormat = "HH:mm";

/// From when on, every day, content is shown as a set of the calibration has it (pipeline/sets.h).
struct SetTime {
  QTime from;
  QString set;

  bool operator==(const SetTime&) const = default;
};

/// The set of a time of the day: of the last that began before it, in the morning that of the evening before.
/// None: there are no times.
std::optional<QString> setAt(const QList<SetTime>& times, QTime now);
/// Of "HH:MM=NAME"; none if it is not.
std::optional<SetTime> setTimeFrom(const QString& text);
QString textOf(const SetTime& time);
/// What is wrong with them: a time or a name that is none, or two of the same time.
std::vector<Message> problems(const QList<SetTime>& times);

}  // namespace relucent::gui
