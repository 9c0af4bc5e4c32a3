// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace relucent::charts {

struct Tick {
  double value = 0.0;
  int decimals = 0;  // that tell neighbours apart
};

/// One axis of a chart: maps values to places along it.
struct Axis {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;
  std::string title{};

  /// 0 at `low`, 1 at `high`, continued beyond both.
  double place(double value) const;
  double value(double place) const;
  /// Round values, about `count` of them: powers of ten over decades, in a logarithmic axis of less than two
  /// 1, 2 and 5 times these, else steps of 1, 2 or 5.
  std::vector<Tick> ticks(int count) const;
  /// Its ticks are powers of ten.
  bool isOverDecades() const { return logarithmic && high >= 100.0 * (1.0 - 1e-9) * low; }
};

/// How numbers are written along an axis.
using TickText = std::string (*)(const Axis& axis, const Tick& tick);

/// "0.25"; "10³" where the axis is over decades.
std::string englishTickText(const Axis& axis, const Tick& tick);

}  // namespace relucent::charts
