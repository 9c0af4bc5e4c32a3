// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <string>

namespace relucent::gui {

/// When something was, as calibrations and records say it: "2026-11-30T12:00:00Z", ISO 8601. Invalid: it says
/// no time. Of the same time zone as it was written in, UTC for all that core writes.
QDateTime timeWritten(const std::string& text);

/// The same in UTC, to the second.
std::string written(const QDateTime& time);

}  // namespace relucent::gui
