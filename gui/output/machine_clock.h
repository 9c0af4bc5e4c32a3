// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <chrono>
#include <functional>

namespace relucent {

/// What a show knows of the machine's time, to be replaced by tests.
struct MachineClock {
  /// On the wall: may be set, and jumps over what the machine slept.
  std::function<QDateTime()> wall = [] { return QDateTime::currentDateTime(); };
  /// How long the machine has slept in all since it was started.
  std::function<std::chrono::nanoseconds()> slept = sleptSinceBoot;

  static std::chrono::nanoseconds sleptSinceBoot();
};

}  // namespace relucent
