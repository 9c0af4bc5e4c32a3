// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <vector>

namespace relucent::gui {

/// One axis of a chart: maps values to positions.
struct Axis {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;
  QString title;

  /// 0 at `low`, 1 at `high`, continued beyond both.
  double place(double value) const;
  double value(double place) const;

  struct Tick {
    double value = 0.0;
    QString text;
  };
  /// Round values: powers of ten where logarithmic, else steps of 1, 2 or 5, about `count` of them.
  std::vector<Tick> ticks(int count) const;
};

}  // namespace relucent::gui
