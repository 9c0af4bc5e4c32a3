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
  /// Round values: powers of ten where logarithmic, else steps of 1, 2 or 5, about `count` of them.
  std::vector<Tick> ticks(int count) const;
};

/// How numbers are written along an axis.
using TickText = std::string (*)(const Axis& axis, const Tick& tick);

/// "0.25"; "10³" where the axis is logarithmic.
std::string englishTickText(const Axis& axis, const Tick& tick);

}  // namespace relucent::charts
