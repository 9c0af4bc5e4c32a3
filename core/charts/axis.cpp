// SPDX-License-Identifier: MIT
#include "relucent/charts/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace relucent::charts {
namespace {

double roundStep(double least) {
  double power = std::pow(10.0, std::floor(std::log10(least)));
  for (double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

int decimalsOf(double step) {
  return std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
}

/// Those of a logarithmic axis of less than two decades.
std::vector<Tick> ticksWithinDecades(double low, double high, std::size_t most) {
  std::vector<Tick> found;
  for (const std::vector<double>& factors : {std::vector{1.0, 2.0, 5.0}, {1.0, 5.0}, {1.0}}) {
    found.clear();
    for (double power = std::pow(10.0, std::floor(std::log10(low))); power <= high; power *= 10.0)
      for (double factor : factors) {
        const double value = factor * power;
        if (value >= low * (1.0 - 1e-9) && value <= high * (1.0 + 1e-9))
          found.push_back({value, decimalsOf(power)});
      }
    if (found.size() <= most) break;
  }
  return found;
}

std::string superior(int number) {
  constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (char c : std::to_string(number)) text += c == '-' ? "⁻" : digits[c - '0'];
  return text;
}

}  // namespace

double Axis::place(double value) const {
  if (logarithmic) return std::log(std::max(value, 1e-300) / low) / std::log(high / low);
  return (value - low) / (high - low);
}

double Axis::value(double at) const {
  if (logarithmic) return low * std::pow(high / low, at);
  return low + at * (high - low);
}

std::vector<Tick> Axis::ticks(int count) const {
  std::vector<Tick> found;
  if (!(high > low) || count < 1) return found;
  if (logarithmic && !isOverDecades())
    return ticksWithinDecades(low, high, static_cast<std::size_t>(count) + 1);
  if (logarithmic) {
    int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
    int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
    int step = std::max(1, (last - first + count) / count);
    for (int exponent = first; exponent <= last; exponent += step)
      found.push_back({std::pow(10.0, exponent), 0});
    return found;
  }
  double step = roundStep((high - low) / count);
  const int decimals = decimalsOf(step);
  for (double value = std::ceil(low / step - 1e-9) * step; value <= high + 1e-9 * step; value += step)
    found.push_back({std::abs(value) < 1e-9 * step ? 0.0 : value, decimals});
  return found;
}

std::string englishTickText(const Axis& axis, const Tick& tick) {
  if (axis.isOverDecades()) {
    int exponent = static_cast<int>(std::lround(std::log10(tick.value)));
    return exponent == 0 ? "1" : exponent == 1 ? "10" : "10" + superior(exponent);
  }
  return fmt::format("{:.{}f}", tick.value, tick.decimals);
}

}  // namespace relucent::charts
