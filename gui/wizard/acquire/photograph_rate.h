// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <deque>
#include <optional>

namespace relucent::gui {

/// How many photographs a minute, of the last half minute:
///   60 (n_now - n_then) / (t_now - t_then),   t_then the oldest of the last 30 s
/// None before there were 5 s to tell. Times are of one clock, and do not run back.
class PhotographRate {
 public:
  using Clock = std::chrono::steady_clock;

  /// `photographs`: since the start; fewer than before, it begins anew.
  void add(Clock::time_point now, int photographs) {
    if (!seen_.empty() && photographs < seen_.back().photographs) seen_.clear();
    seen_.push_back({now, photographs});
    while (seen_.size() > 2 && now - seen_.front().when > window) seen_.pop_front();
  }
  std::optional<double> perMinute() const {
    if (seen_.empty() || seen_.back().when - seen_.front().when < least) return std::nullopt;
    const std::chrono::duration<double, std::ratio<60>> minutes = seen_.back().when - seen_.front().when;
    return (seen_.back().photographs - seen_.front().photographs) / minutes.count();
  }
  /// What was held up says nothing of the rate.
  void forget() { seen_.clear(); }

 private:
  static constexpr std::chrono::seconds window{30}, least{5};
  struct Seen {
    Clock::time_point when;
    int photographs;
  };
  std::deque<Seen> seen_;
};

}  // namespace relucent::gui
