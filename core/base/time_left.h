// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <deque>
#include <optional>

#include "relucent/base/message.h"

namespace relucent {

/// How much longer long work takes: what somebody who knows the work expects, counted down by the clock;
/// where nobody does, or that time has passed, what follows from the mean rate of the last half minute. Not
/// from the whole: what is read from a journal or a cache says nothing about the next stage.
class TimeLeft {
 public:
  using Moment = std::chrono::steady_clock::time_point;

  /// `fraction` of the work is done.
  void add(Moment now, double fraction);
  /// So many seconds are expected from now on.
  void expect(Moment now, double seconds);
  /// Nothing is done until resume().
  void pause(Moment now);
  void resume(Moment now);
  /// Seconds. None: not known yet.
  std::optional<double> seconds(Moment now) const;

 private:
  struct Sample {
    Moment time;
    double fraction;
  };
  std::deque<Sample> samples_;
  std::optional<Moment> expectedEnd_, paused_;
};

/// Of what is still to come, rounded up: "under a minute", "11 min", "2 h 5 min". No forecast of a
/// measurement knows seconds.
Message expectedDuration(double seconds);
/// So little that expectedDuration() does not say how much.
bool isUnderAMinute(double seconds);

/// Of what was taken, to the nearest: "2 s", "75 s", "11 min", "2 h 5 min".
Message spentDuration(double seconds);

}  // namespace relucent
