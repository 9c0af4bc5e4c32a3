// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>

#include "output/rehearsal_clock.h"

namespace relucent::gui {

/// The system's clocks as a show uses them, replaceable in tests and rehearsals.
struct MachineClock {
  /// Wall-clock time: may be set, and jumps over a suspend.
  std::function<QDateTime()> wall = [] { return QDateTime::currentDateTime(); };
  /// Total time that the machine has been suspended since it was started.
  std::function<std::chrono::nanoseconds()> slept = sleptSinceBoot;
  /// Where a show is rehearsed, its time; else nullptr.
  std::shared_ptr<RehearsalClock> rehearsal{};

  /// How long a show really waits where it is to wait for so long.
  std::chrono::milliseconds pause(std::chrono::milliseconds usual) const {
    return rehearsal ? std::max(usual / RehearsalClock::haste, std::chrono::milliseconds(1)) : usual;
  }
  /// Of a show that is rehearsed.  Throws: as RehearsalClock.
  static MachineClock rehearsed(const QString& file);

  static std::chrono::nanoseconds sleptSinceBoot();
};

}  // namespace relucent::gui
