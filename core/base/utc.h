// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/chrono.h>

#include <chrono>
#include <string>

namespace relucent {

/// ISO 8601, UTC, to the second: 2026-01-31T12:00:00Z.
inline std::string utcText(std::chrono::system_clock::time_point time) {
  const auto seconds = std::chrono::time_point_cast<std::chrono::seconds>(time);
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)));
}
inline std::string utcNow() {
  return utcText(std::chrono::system_clock::now());
}

}  // namespace relucent
