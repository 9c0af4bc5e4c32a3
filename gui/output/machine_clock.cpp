// SPDX-License-Identifier: MIT
#include "output/machine_clock.h"

#include <ctime>

namespace relucent::gui {
namespace {

std::chrono::nanoseconds timeOn(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

std::chrono::nanoseconds MachineClock::sleptSinceBoot() {
  // One of the two clocks stands still meanwhile.
  return timeOn(CLOCK_BOOTTIME) - timeOn(CLOCK_MONOTONIC);
}

MachineClock MachineClock::rehearsed(const QString& file) {
  MachineClock clock;
  clock.rehearsal = std::make_shared<RehearsalClock>(file);
  clock.wall = [rehearsal = clock.rehearsal] { return rehearsal->now(); };
  return clock;
}

}  // namespace relucent::gui
