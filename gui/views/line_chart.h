// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>
#include <vector>

#include "relucent/charts/chart.h"

namespace relucent::gui {

/// Curves over two axes. The accessible description summarises them.
class LineChart : public QWidget {
  Q_OBJECT

 public:
  LineChart(charts::Axis x, charts::Axis y, QWidget* parent = nullptr);
  void setAxes(const charts::Axis& x, const charts::Axis& y);
  void setCurves(std::vector<charts::Curve> curves);
  /// A dashed vertical line at a value; NaN: none.
  void setMark(double x);
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  charts::Chart chart_;
};

/// An axis with a title in the user's language.
charts::Axis axisOf(double low, double high, const QString& title);

}  // namespace relucent::gui
