// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>
#include <vector>

#include "views/axis.h"

namespace relucent::gui {

/// Markers of a curve's points, so that curves differ not only in colour.
enum class Marker { none, circle, square, triangle };

struct Curve {
  QString name;
  const QColor& (*colour)() = nullptr;
  Marker marker = Marker::none;
  std::vector<QPointF> line;    // drawn through
  std::vector<QPointF> points;  // marked
};

/// The plot area within a widget, with axes, grid and titles around it.
QRectF drawAxes(QPainter& painter, const QRectF& area, const Axis& x, const Axis& y);

/// Minimum size for the titles and a small plot.
QSize leastSizeOf(const Axis& x, const Axis& y);

/// Curves over two axes. The accessible description summarises them.
class LineChart : public QWidget {
  Q_OBJECT

 public:
  LineChart(Axis x, Axis y, QWidget* parent = nullptr);
  void setAxes(const Axis& x, const Axis& y);
  void setCurves(std::vector<Curve> curves);
  /// A dashed vertical line at a value; NaN: none.
  void setMark(double x);
  QSize minimumSizeHint() const override { return leastSizeOf(x_, y_); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintLegend(QPainter& painter, const QRectF& plot) const;
  Axis x_, y_;
  double mark_;
  std::vector<Curve> curves_;
};

}  // namespace relucent::gui
