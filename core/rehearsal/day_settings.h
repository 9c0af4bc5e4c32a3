// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

#include "relucent/base/message.h"

namespace relucent::rehearsal {

/// Hours of a rehearsed day.
inline constexpr std::chrono::hours opens{9}, closes{18}, nightAt{20};

struct DaysSettings {
  std::filesystem::path calibration;  // of a simulated venue; stays as it is
  int days = 30;
  double daySeconds = 20.0;       // that a day takes at least, what is waited for in it besides
  std::filesystem::path out;      // a new folder: a copy of the calibration, the show's log, the content
  std::filesystem::path program;  // relucent
  bool onScreens = false;         // on this desktop's displays, one of each projector's size; else on none
  std::filesystem::path cache;    // of traced venues; empty: none
};
std::vector<Message> problems(const DaysSettings& settings);

}  // namespace relucent::rehearsal
