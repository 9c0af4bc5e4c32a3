// SPDX-License-Identifier: MIT
#include "views/line_chart.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <limits>

#include "theme/theme.h"

namespace relucent::gui {
namespace {

void drawMarker(QPainter& painter, Marker marker, QPointF at) {
  constexpr double r = 3.5;
  switch (marker) {
    case Marker::none:
      return;
    case Marker::circle:
      painter.drawEllipse(at, r, r);
      return;
    case Marker::square:
      painter.drawRect(QRectF(at.x() - r, at.y() - r, 2 * r, 2 * r));
      return;
    case Marker::triangle:
      painter.drawPolygon(QPolygonF(
          {at + QPointF(0, -r - 0.5), at + QPointF(r + 0.5, r - 0.5), at + QPointF(-r - 0.5, r - 0.5)}));
  }
}

}  // namespace

QRectF drawAxes(QPainter& painter, const QRectF& area, const Axis& x, const Axis& y) {
  painter.setFont(typeOf(type::axis));
  QFontMetricsF metrics(painter.font());
  std::vector<Axis::Tick> rows = y.ticks(std::max(1, static_cast<int>(area.height() / 42.0)));
  double left = 8.0;
  for (const Axis::Tick& tick : rows) left = std::max(left, metrics.horizontalAdvance(tick.text) + 12.0);
  double top = y.title.isEmpty() ? 8.0 : metrics.height() + 10.0;
  double bottom = metrics.height() + 8.0 + (x.title.isEmpty() ? 0.0 : metrics.height() + 4.0);
  QRectF plot = area.adjusted(left, top, -12.0, -bottom);
  std::vector<Axis::Tick> columns = x.ticks(std::max(1, static_cast<int>(plot.width() / 90.0)));

  painter.setPen(colours().secondary);
  if (!y.title.isEmpty())
    painter.drawText(QRectF(area.left(), area.top(), area.width(), metrics.height() + 2.0),
                     Qt::AlignAbsolute | Qt::AlignLeft, y.title);
  if (!x.title.isEmpty())
    painter.drawText(
        QRectF(plot.left(), plot.bottom() + metrics.height() + 8.0, plot.width(), metrics.height() + 2.0),
        Qt::AlignHCenter, x.title);
  for (const Axis::Tick& tick : rows) {
    double at = plot.bottom() - y.place(tick.value) * plot.height();
    painter.setPen(colours().line);
    painter.drawLine(QPointF(plot.left(), at), QPointF(plot.right(), at));
    painter.setPen(colours().secondary);
    painter.drawText(QRectF(area.left(), at - metrics.height() / 2.0, left - 8.0, metrics.height()),
                     Qt::AlignAbsolute | Qt::AlignRight | Qt::AlignVCenter, tick.text);
  }
  painter.setPen(colours().border);
  painter.drawLine(plot.bottomLeft(), plot.bottomRight());
  for (const Axis::Tick& tick : columns) {
    double at = plot.left() + x.place(tick.value) * plot.width();
    painter.setPen(colours().border);
    painter.drawLine(QPointF(at, plot.bottom()), QPointF(at, plot.bottom() + 4.0));
    painter.setPen(colours().secondary);
    painter.drawText(QRectF(at - 50.0, plot.bottom() + 5.0, 100.0, metrics.height() + 2.0), Qt::AlignHCenter,
                     tick.text);
  }
  return plot;
}

QSize leastSizeOf(const Axis& x, const Axis& y) {
  constexpr double widthBesidePlot = 56.0, leastWidth = 160.0;  // beside the plot: numbers, and what is free
  constexpr int leastHeight = 96;
  QFontMetricsF metrics(typeOf(type::axis));
  double across = metrics.horizontalAdvance(x.title) + widthBesidePlot;
  return {static_cast<int>(std::ceil(std::max({leastWidth, across, metrics.horizontalAdvance(y.title)}))),
          leastHeight};
}

LineChart::LineChart(Axis x, Axis y, QWidget* parent)
    : QWidget(parent), x_(std::move(x)), y_(std::move(y)), mark_(std::numeric_limits<double>::quiet_NaN()) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  connect(&Theme::instance(), &Theme::changed, this, qOverload<>(&QWidget::update));
}

void LineChart::setAxes(const Axis& x, const Axis& y) {
  x_ = x;
  y_ = y;
  updateGeometry();
  update();
}

void LineChart::setCurves(std::vector<Curve> curves) {
  curves_ = std::move(curves);
  update();
}

void LineChart::setMark(double x) {
  mark_ = x;
  update();
}

void LineChart::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QRectF plot = drawAxes(painter, rect(), x_, y_);
  auto place = [&](QPointF value) {
    return QPointF(plot.left() + x_.place(value.x()) * plot.width(),
                   plot.bottom() - y_.place(value.y()) * plot.height());
  };
  painter.save();
  painter.setClipRect(plot.adjusted(-6, -6, 6, 6));
  if (!std::isnan(mark_)) {
    painter.setPen(QPen(colours().amber, 1.0, Qt::DashLine));
    painter.drawLine(place({mark_, y_.low}), place({mark_, y_.high}));
  }
  for (const Curve& curve : curves_) {
    painter.setPen(QPen(curve.colour(), 1.6));
    painter.setBrush(Qt::NoBrush);
    QPolygonF line;
    for (QPointF value : curve.line) line.append(place(value));
    painter.drawPolyline(line);
    painter.setBrush(colours().card);
    for (QPointF value : curve.points) drawMarker(painter, curve.marker, place(value));
  }
  painter.restore();
  paintLegend(painter, plot);
}

void LineChart::paintLegend(QPainter& painter, const QRectF& plot) const {
  painter.setFont(typeOf(type::note));
  double y = plot.top() + 12.0;
  for (const Curve& curve : curves_) {
    if (curve.name.isEmpty()) continue;
    double x = plot.left() + 20.0;
    painter.setPen(QPen(curve.colour(), 1.6));
    painter.setBrush(colours().card);
    painter.drawLine(QPointF(x, y), QPointF(x + 26.0, y));
    drawMarker(painter, curve.marker, {x + 13.0, y});
    painter.setPen(colours().text);
    painter.drawText(QPointF(x + 36.0, y + 4.0), curve.name);
    y += 22.0;
  }
}

}  // namespace relucent::gui
