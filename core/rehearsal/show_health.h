// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace relucent::rehearsal {

/// A time of the show's, in the time zone that it was started in.
using ShowTime = std::chrono::sys_seconds;

/// Of "2026-05-04T08:50:00", and what follows the seconds; none if it is no time.
std::optional<ShowTime> showTimeFrom(const std::string& text);
/// "2026-05-04T08:50:00"
std::string textOf(ShowTime time);

/// What of a show's health.json a venue looks at.
struct ShowHealth {
  ShowTime updated{};
  std::string state;                   // as ShowState is named
  int item = -1;                       // that plays
  std::vector<std::string> power;      // of each projector; empty where it does not answer
  std::optional<ShowTime> night{};     // when the last one was
  std::string alarm{};                 // empty: nobody has to look
  std::vector<std::string> streams{};  // the state of each
  int skipped = 0;                     // items that cannot be read
};

/// Throws: Error{format}.
ShowHealth showHealthFrom(std::string_view json);

}  // namespace relucent::rehearsal
