// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <chrono>
#include <functional>

namespace relucent::gui {

/// The system's clocks as a show uses them, replaceable in tests.
struct MachineClock {
  /// Wall-clock time: may be set, and jumps over a suspend.
  std::function<QDateTime()> wall = [] { return QDateTime::currentDateTime(); };
  /// Total time that the machine has been suspended since it was started.
  std::function<std::chrono::nanoseconds()> slept = sleptSinceBoot;

  static std::chrono::nanoseconds sleptSinceBoot();
};

}  // namespace relucent::gui
