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

Message roundedDuration(double seconds) {
  constexpr double minute = 60.0, hour = 3600.0;
  const auto whole = [](double value) { return as::count(static_cast<std::int64_t>(value)); };
  if (seconds <= minute - 10.0)
    return RELUCENT_MESSAGE("duration.seconds", "{} s")
        .with(whole(std::max(10.0, 10.0 * std::ceil(seconds / 10.0))));
  const double minutes = std::ceil(seconds / minute);
  if (seconds <= hour) return RELUCENT_MESSAGE("duration.minutes", "{} min").with(whole(minutes));
  return RELUCENT_MESSAGE("duration.hours-minutes", "{} h {} min")
      .with(whole(std::floor(minutes / 60.0)), whole(std::fmod(minutes, 60.0)));
}

}  // namespace relucent
