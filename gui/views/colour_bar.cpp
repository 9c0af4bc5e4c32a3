// SPDX-License-Identifier: MIT
#include "views/colour_bar.h"

#include "theme/theme.h"
#include "views/chart_drawing.h"
#include "views/number_text.h"

namespace relucent::gui {

QRectF colourBarIn(const QRectF& area) {
  QRectF bar(area.left() + 10.0, area.top() + 30.0, 12.0, area.height() - 42.0);
  return bar.height() < 40.0 ? QRectF() : bar;
}

void drawColourBar(QPainter& painter, const QRectF& area, const ColourScale& scale) {
  QRectF bar = colourBarIn(area);
  int rows = static_cast<int>(bar.height());
  for (int y = 0; y < rows; ++y)
    painter.fillRect(QRectF(bar.left(), bar.top() + y, bar.width(), 1.5),
                     qtColourAt(scale.map, 1.0 - (y + 0.5) / rows));
}

void drawColourBarWords(QPainter& painter, const QRectF& area, const ColourScale& scale, const QString& unit,
                        bool percent) {
  // On the dark ground behind pictures, whatever the theme.
  const Colours& dark = colours(Look::dark);
  painter.setFont(typeOf(type::axis));
  painter.setPen(dark.secondary);
  painter.drawText(QRectF(area.left(), area.top() + 4.0, area.width(), 18.0), Qt::AlignCenter, unit);
  QRectF bar = colourBarIn(area);
  if (bar.isEmpty()) return;
  painter.setPen(dark.border);
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(bar);
  charts::Axis axis{scale.low, scale.high, scale.logarithmic, {}};
  painter.setPen(dark.text);
  for (const charts::Tick& tick : axis.ticks(std::max(2, static_cast<int>(bar.height()) / 60))) {
    double y = bar.bottom() - axis.place(tick.value) * bar.height();
    QString text = percent ? percentText(tick.value) : tickTextOf(axis, tick);
    painter.drawText(QRectF(bar.right() + 5.0, y - 8.0, area.right() - bar.right() - 5.0, 16.0),
                     Qt::AlignAbsolute | Qt::AlignLeft | Qt::AlignVCenter, text);
  }
}

}  // namespace relucent::gui
