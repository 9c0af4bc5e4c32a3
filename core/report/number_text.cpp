// SPDX-License-Identifier: MIT
#include "relucent/report/number_text.h"

#include <fmt/format.h>

#include <cmath>

namespace relucent::report {

std::string percent(double share) {
  return fmt::format("{:.1f} %", 100.0 * share);
}

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t place = digits.size(); place > 3; place -= 3) digits.insert(place - 3, "\u202f");
  return digits;
}

std::string duration(double seconds) {
  if (seconds < 60.0) return fmt::format("{:.3g} s", seconds);
  return fmt::format("{:.0f} min {:.0f} s", std::floor(seconds / 60.0), std::fmod(seconds, 60.0));
}

std::string decibels(double value) {
  return std::isfinite(value) ? fmt::format("{:.1f} dB", value) : "exact";
}

}  // namespace relucent::report
