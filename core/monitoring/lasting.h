// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

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
  double seen = 0.0;         // share of photographs, whatever their weight, that must agree likewise
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
  /// Whether at least `held` of the weight, and `seen` of the photographs, is farther below (sign < 0) or
  /// above than nearly all of `limit`.
  bool holds(double limit, int sign) const;
  /// Share of the photographs, whatever their weight, that are farther below (sign < 0) or above than this.
  double shareBeyond(double limit, int sign) const;
  /// Whether at least `held` of the weight is as near as this to the median. Contract: median() has a value.
  bool keeps(double within) const;

 private:
  struct One {
    double seconds, value, weight;
  };
  LastingSettings settings_;
  std::deque<One> seen_;
};

struct ReferenceSettings {
  double seconds = 600.0;     // from the first photograph that tells something
  std::size_t least = 60;     // of them
  double informative = 0.04;  // a larger deviation tells nothing
  double most = 0.01;         // further than this nothing is taken for an error of the measurement
};

/// How far a quantity was off from the beginning, which is what calibration has wrong: the median of the
/// first minutes' photographs, held within narrow limits, so that a change from before the beginning is still
/// told.
class Reference {
 public:
  explicit Reference(const ReferenceSettings& settings = {}) : settings_(settings) {}
  void add(double seconds, double value, double deviation);
  /// 0 until the first minutes are over.
  double value() const { return value_; }

 private:
  ReferenceSettings settings_;
  std::vector<double> first_;
  std::optional<double> begin_;
  bool isKnown_ = false;
  double value_ = 0.0;
};

}  // namespace relucent::monitoring
