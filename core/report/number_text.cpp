// SPDX-License-Identifier: MIT
#include "relucent/report/number_text.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iomanip>
#include <sstream>

namespace relucent::report {

std::string percent(double share) {
  const double percents = 100.0 * share;
  // As the wizard writes them: what is small is not nothing.
  const int decimals = std::abs(percents) >= 99.95 || percents == 0.0 ? 0
                       : std::abs(percents) < 0.095                   ? 2
                                                                      : 1;
  const std::string text = fmt::format("{:.{}f} %", percents, decimals);
  return text == "-0.00 %" || text == "0.00 %" ? "0 %" : text;
}

std::string smallPercent(double share) {
  const double percents = 100.0 * share;
  if (percents >= 0.1 || !(percents > 0.0)) return percent(share);
  return fmt::format("{:.{}f} %", percents, 1 - static_cast<int>(std::floor(std::log10(percents))));
}

std::string exposureTime(double seconds) {
  if (seconds >= 0.3 || !(seconds > 0.0)) return fmt::format("{:.3g} s", seconds);
  return fmt::format("1/{:.0f} s", 1.0 / seconds);
}

std::string stageDuration(double seconds) {
  return duration(std::max(1.0, std::round(seconds)));
}

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t place = digits.size(); place > 3; place -= 3) digits.insert(place - 3, "\u202f");
  return digits;
}

std::string duration(double seconds) {
  if (seconds < 0.1) return fmt::format("{:.3g} ms", 1000.0 * seconds);
  if (seconds < 60.0) return fmt::format("{:.3g} s", seconds);
  return fmt::format("{:.0f} min {:.0f} s", std::floor(seconds / 60.0), std::fmod(seconds, 60.0));
}

std::string localTime(const std::string& iso) {
  std::istringstream stream(iso);
  std::tm utc{};
  stream >> std::get_time(&utc, "%Y-%m-%dT%H:%M:%SZ");
  if (stream.fail()) return iso;
  const std::tm local = fmt::localtime(timegm(&utc));
  return fmt::format("{} {:%B %Y, %H:%M}", local.tm_mday, local);
}

std::string decibels(double value) {
  return std::isfinite(value) ? fmt::format("{:.1f} dB", value) : "exact";
}

}  // namespace relucent::report
