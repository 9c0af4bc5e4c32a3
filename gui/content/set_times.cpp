// SPDX-License-Identifier: MIT
#include "content/set_times.h"

#include <algorithm>

namespace relucent::gui {

std::optional<QString> setAt(const QList<SetTime>& times, QTime now) {
  const SetTime *last = nullptr, *before = nullptr;  // of the day, and of it until now
  for (const SetTime& time : times) {
    if (last == nullptr || time.from > last->from) last = &time;
    if (time.from <= now && (before == nullptr || time.from > before->from)) before = &time;
  }
  if (last == nullptr) return std::nullopt;
  return (before != nullptr ? before : last)->set;
}

std::optional<SetTime> setTimeFrom(const QString& text) {
  const qsizetype equals = text.indexOf('=');
  SetTime time{QTime::fromString(text.left(equals).trimmed(), "H:mm"), text.mid(equals + 1)};
  if (equals < 0 || !problems({time}).empty()) return std::nullopt;
  return time;
}

QString textOf(const SetTime& time) {
  return time.from.toString(setTimeFormat) + '=' + time.set;
}

std::vector<Message> problems(const QList<SetTime>& times) {
  std::vector<Message> found;
  for (const SetTime& time : times) {
    if (!time.from.isValid() || time.set.isEmpty())
      found.push_back(RELUCENT_ENGLISH_MESSAGE("content.set-time-unreadable",
                                               "a set is shown from a time on, as 18:00, and has a name"));
    else if (std::ranges::count(times, time.from, &SetTime::from) > 1)
      found.push_back(RELUCENT_ENGLISH_MESSAGE("content.two-sets-at-a-time",
                                               "two sets are to be shown from {} on: take one of them out")
                          .with(time.from.toString(setTimeFormat).toStdString()));
  }
  return found;
}

}  // namespace relucent::gui
