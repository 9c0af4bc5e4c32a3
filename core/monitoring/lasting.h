// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <optional>

namespace relucent::monitoring {

/// What many photographs say of one quantity, each with a standard deviation.
struct LastingSettings {
  double window = 40.0;      // seconds that are looked back
  double leastSpan = 15.0;   // seconds that photographs which tell something must span
  std::size_t least = 8;     // and their number
  double informative = 0.1;  // a larger deviation tells nothing
  double floor = 0.005;      // of a deviation: what photographs have wrong in common
  double held = 0.75;        // share of weight that must agree that the limit is passed, or nearly
  double nearly = 0.7;       // of the limit
};

/// The weighted median of the photographs of the last seconds, in which what lasts less than half of them
/// does not show; and whether it has been beyond a limit nearly all the time.
class Lasting {
 public:
  explicit Lasting(const LastingSettings& settings = {}) : settings_(settings) {}
  void add(double seconds, double value, double deviation);
  void forget() { seen_.clear(); }
  /// None: too few photographs tell.
  std::optional<double> median() const;
  /// Root of the mean square of their deviations, weighted: not over their number, since what T has wrong is
  /// the same in all of them. Contract: median() has a value.
  double deviation() const;
  /// Whether at least `held` of the weight is farther below (sign < 0) or above than nearly all of `limit`.
  bool holds(double limit, int sign) const;
  /// Whether at least `held` of the weight is as near as this to the median. Contract: median() has a value.
  bool keeps(double within) const;

 private:
  struct One {
    double seconds, value, weight;
  };
  LastingSettings settings_;
  std::deque<One> seen_;
};

}  // namespace relucent::monitoring
