// SPDX-License-Identifier: MIT
#include "relucent/base/time_left.h"

#include <algorithm>
#include <cmath>

namespace relucent {

using Seconds = std::chrono::duration<double>;

void TimeLeft::add(Moment now, double fraction) {
  constexpr Seconds apart{1.0};
  constexpr Seconds window{30.0};
  // Between two samples only the newest moves, so that there are never more than a few dozen.
  if (samples_.size() >= 2 && now - samples_[samples_.size() - 2].time < apart)
    samples_.back() = {now, fraction};
  else
    samples_.push_back({now, fraction});
  while (samples_.size() > 2 && now - samples_[1].time >= window) samples_.pop_front();
}

void TimeLeft::expect(Moment now, double seconds) {
  expectedEnd_ = now + std::chrono::duration_cast<Moment::duration>(Seconds(seconds));
}

void TimeLeft::pause(Moment now) {
  if (!paused_) paused_ = now;
}

void TimeLeft::resume(Moment now) {
  if (!paused_) return;
  const Moment::duration stood = now - *paused_;
  if (expectedEnd_) *expectedEnd_ += stood;
  for (Sample& sample : samples_) sample.time += stood;
  paused_.reset();
}

std::optional<double> TimeLeft::seconds(Moment now) const {
  constexpr Seconds leastTime{3.0};
  const Moment moment = paused_.value_or(now);
  if (expectedEnd_ && *expectedEnd_ > moment) return Seconds(*expectedEnd_ - moment).count();
  if (!samples_.empty()) {
    const Seconds time = samples_.back().time - samples_.front().time;
    const double share = samples_.back().fraction - samples_.front().fraction;
    if (time >= leastTime && share > 0.0) return time.count() * ((1.0 - samples_.back().fraction) / share);
  }
  return expectedEnd_ ? std::optional(0.0) : std::nullopt;
}

namespace {

constexpr double minute = 60.0, hour = 3600.0;

auto whole(double value) {
  return as::count(static_cast<std::int64_t>(value));
}

Message inMinutes(double minutes) {
  if (minutes <= hour / minute) return RELUCENT_MESSAGE("duration.minutes", "{} min").with(whole(minutes));
  return RELUCENT_MESSAGE("duration.hours-minutes", "{} h {} min")
      .with(whole(std::floor(minutes / 60.0)), whole(std::fmod(minutes, 60.0)));
}

}  // namespace

Message expectedDuration(double seconds) {
  if (isUnderAMinute(seconds)) return RELUCENT_MESSAGE("duration.under-a-minute", "under a minute");
  return inMinutes(std::ceil(seconds / minute));
}

bool isUnderAMinute(double seconds) {
  return seconds < minute;
}

Message spentDuration(double seconds) {
  constexpr double secondsUpTo = 100.0;
  const double rounded = std::max(1.0, std::round(seconds));
  if (rounded < secondsUpTo) return RELUCENT_MESSAGE("duration.seconds", "{} s").with(whole(rounded));
  return inMinutes(std::round(seconds / minute));
}

}  // namespace relucent
