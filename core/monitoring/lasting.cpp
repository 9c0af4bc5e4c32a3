// SPDX-License-Identifier: MIT
#include "relucent/monitoring/lasting.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace relucent::monitoring {

void Lasting::add(double seconds, double value, double deviation) {
  while (!seen_.empty() && seen_.front().seconds < seconds - settings_.window) seen_.pop_front();
  if (deviation > settings_.informative || !std::isfinite(value)) return;
  const double sum = deviation * deviation + settings_.floor * settings_.floor;
  seen_.push_back({seconds, value, 1.0 / sum});
}

std::optional<double> Lasting::median() const {
  if (seen_.size() < settings_.least || seen_.back().seconds - seen_.front().seconds < settings_.leastSpan)
    return std::nullopt;
  std::vector<std::pair<double, double>> sorted;
  double total = 0.0;
  for (const One& one : seen_) {
    sorted.emplace_back(one.value, one.weight);
    total += one.weight;
  }
  std::sort(sorted.begin(), sorted.end());
  double below = 0.0;
  for (const auto& [value, weight] : sorted) {
    below += weight;
    if (below >= 0.5 * total) return value;
  }
  return sorted.back().first;
}

double Lasting::deviation() const {
  double weights = 0.0;
  for (const One& one : seen_) weights += one.weight;
  return std::sqrt(static_cast<double>(seen_.size()) / weights);
}

bool Lasting::holds(double limit, int sign) const {
  double total = 0.0, beyond = 0.0;
  for (const One& one : seen_) {
    total += one.weight;
    if (sign * one.value > settings_.nearly * limit) beyond += one.weight;
  }
  return total > 0.0 && beyond >= settings_.held * total &&
         shareBeyond(settings_.nearly * limit, sign) >= settings_.seen;
}

double Lasting::shareBeyond(double limit, int sign) const {
  const auto beyond =
      std::count_if(seen_.begin(), seen_.end(), [&](const One& one) { return sign * one.value > limit; });
  return seen_.empty() ? 0.0 : static_cast<double>(beyond) / static_cast<double>(seen_.size());
}

bool Lasting::keeps(double within) const {
  const double middle = *median();
  double total = 0.0, near = 0.0;
  for (const One& one : seen_) {
    total += one.weight;
    if (std::abs(one.value - middle) <= within) near += one.weight;
  }
  return near >= settings_.held * total;
}

void Reference::add(double seconds, double value, double deviation) {
  if (isKnown_ || deviation > settings_.informative || !std::isfinite(value)) return;
  if (!begin_) begin_ = seconds;
  first_.push_back(value);
  isKnown_ = seconds - *begin_ >= settings_.seconds && first_.size() >= settings_.least;
  if (!isKnown_) return;
  const auto middle = first_.begin() + static_cast<std::ptrdiff_t>(first_.size() / 2);
  std::nth_element(first_.begin(), middle, first_.end());
  value_ = std::clamp(*middle, -settings_.most, settings_.most);
  first_ = {};
}

}  // namespace relucent::monitoring
