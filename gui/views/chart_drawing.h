// SPDX-License-Identifier: MIT
#pragma once

#include <QPainter>
#include <QString>

#include "relucent/charts/chart.h"

namespace relucent::gui {

/// A number along an axis, by the locale.
QString tickTextOf(const charts::Axis& axis, const charts::Tick& tick);

/// Draws core's chart in the colours of the theme. Returns where x and y map to.
QRectF drawChart(QPainter& painter, const QRectF& area, const charts::Chart& chart);

/// Minimum size for the titles and a small plot.
QSize leastSizeOf(const charts::Chart& chart);

}  // namespace relucent::gui
