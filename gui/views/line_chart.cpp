// SPDX-License-Identifier: MIT
#include "views/line_chart.h"

#include <QPainter>

#include "theme/accessible_role.h"
#include "theme/theme.h"
#include "views/chart_drawing.h"

namespace relucent::gui {

LineChart::LineChart(charts::Axis x, charts::Axis y, QWidget* parent)
    : QWidget(parent), chart_{{}, std::move(x), std::move(y)} {
  setAccessibleRole(this, QAccessible::Chart);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  connect(&Theme::instance(), &Theme::changed, this, qOverload<>(&QWidget::update));
}

void LineChart::setAxes(const charts::Axis& x, const charts::Axis& y) {
  chart_.x = x;
  chart_.y = y;
  updateGeometry();
  update();
}

void LineChart::setCurves(std::vector<charts::Curve> curves) {
  chart_.curves = std::move(curves);
  update();
}

void LineChart::setMark(double x) {
  chart_.mark = x;
  update();
}

QSize LineChart::minimumSizeHint() const {
  return leastSizeOf(chart_);
}

void LineChart::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  drawChart(painter, rect(), chart_);
}

charts::Axis axisOf(double low, double high, const QString& title) {
  return {low, high, false, title.toStdString()};
}

}  // namespace relucent::gui
