// SPDX-License-Identifier: MIT
#include "views/chart_drawing.h"

#include <QFontMetricsF>
#include <QSvgRenderer>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "relucent/charts/svg.h"
#include "text/local_digits.h"
#include "theme/theme.h"
#include "views/number_text.h"

namespace relucent::gui {
namespace {

std::string localTickText(const charts::Axis& axis, const charts::Tick& tick) {
  return tickTextOf(axis, tick).toStdString();
}

QString styleOf(const char* name, const QColor& stroke) {
  return QString(".%1{stroke:%2;fill:none;stroke-width:1.6}").arg(name, stroke.name());
}

std::string styleSheet() {
  const Colours& c = colours();
  QString css, family = typeOf(type::axis).families().join("','");
  for (auto [name, pixels, colour] :
       {std::tuple("number", type::axis, &c.secondary), std::tuple("title", type::axis, &c.secondary),
        std::tuple("legend", type::note, &c.text)})
    css += QString(".%1{font-family:'%2';font-size:%3px;fill:%4}")
               .arg(name, family)
               .arg(pixels)
               .arg(colour->name());
  css += QString(".grid{stroke:%1}.axis{stroke:%2}").arg(c.line.name(), c.border.name());
  css += QString(".mark{stroke:%1;stroke-dasharray:4 2}").arg(c.amber.name());
  for (auto [name, colour] : {std::pair("red", &c.red), std::pair("green", &c.green),
                              std::pair("blue", &c.blue), std::pair("accent", &c.accent),
                              std::pair("amber", &c.amber), std::pair("information", &c.information)})
    css += styleOf(name, *colour);
  css += QString(".point{fill:%1}").arg(c.card.name());
  css += QString(".kept{fill:%1;fill-opacity:0.8}").arg(c.accent.name());
  css += QString(".dropped{fill:%1;fill-opacity:0.45}").arg(c.border.name());
  return css.toStdString();
}

}  // namespace

QString tickTextOf(const charts::Axis& axis, const charts::Tick& tick) {
  if (axis.isOverDecades()) return powerOfTen(static_cast<int>(std::lround(std::log10(tick.value))));
  return decimalText(tick.value, tick.decimals);
}

QRectF drawChart(QPainter& painter, const QRectF& area, const charts::Chart& chart) {
  charts::Drawing drawing{{area.width(), area.height()}, styleSheet(), localTickText};
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  // Qt SVG divides by the painter's font size in points, which is -1 where the size was given in pixels.
  QFont inPoints = painter.font();
  inPoints.setPointSize(10);
  painter.setFont(inPoints);
  QSvgRenderer(QByteArray::fromStdString(charts::svgOf(chart, drawing))).render(&painter, area);
  painter.restore();
  charts::PlotArea plot = charts::plotOf(chart, drawing);
  return {area.left() + plot.left, area.top() + plot.top, plot.width, plot.height};
}

QSize leastSizeOf(const charts::Chart& chart) {
  constexpr double widthBesidePlot = 56.0, leastWidth = 160.0;  // beside the plot: numbers, and what is free
  constexpr int leastHeight = 96;
  QFontMetricsF metrics(typeOf(type::axis));
  auto widthOf = [&](const std::string& title) {
    return metrics.horizontalAdvance(QString::fromStdString(title));
  };
  double width = std::max({leastWidth, widthOf(chart.x.title) + widthBesidePlot, widthOf(chart.y.title)});
  return {static_cast<int>(std::ceil(width)), leastHeight};
}

}  // namespace relucent::gui
