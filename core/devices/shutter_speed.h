// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace relucent::devices {

/// The exposure time that a camera's word for it means, in seconds: "1/125", "0.5", "0,5", "1.3s", "30\"",
/// "0\"5", "4/10", "1/1,5", "0.0080s". None for words (bulb, time, auto) and everything else.
std::optional<double> secondsFromShutter(std::string_view word);

/// Whether the word stands for a shutter that stays open until it is told to close, in the languages that
/// libgphoto2 speaks it.
bool isBulb(std::string_view word);

/// The shutter times of a camera, as it lists them.
class ShutterList {
 public:
  ShutterList() = default;
  /// Words that mean no time are left out, but for bulb.
  explicit ShutterList(const std::vector<std::string>& words);

  struct Speed {
    std::string word;
    double seconds = 0.0;
  };

  bool empty() const { return speeds_.empty(); }
  /// Contract: not empty.
  double shortest() const { return speeds_.front().seconds; }
  double longest() const { return speeds_.back().seconds; }
  const std::optional<std::string>& bulb() const { return bulb_; }
  /// The time whose ratio to `seconds` is nearest to 1. Contract: not empty, seconds > 0.
  const Speed& nearest(double seconds) const;
  /// Whether only bulb comes near: longer than the list by more than half of its last step. Without bulb
  /// never.
  bool needsBulb(double seconds) const;

 private:
  std::vector<Speed> speeds_;  // ascending
  std::optional<std::string> bulb_;
};

}  // namespace relucent::devices
