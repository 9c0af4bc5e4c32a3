// SPDX-License-Identifier: MIT
#include "views/view_tag.h"

#include <QPainter>
#include <algorithm>

#include "theme/theme.h"

namespace relucent::gui {

QSizeF tagSize(const QString& text) {
  return QFontMetricsF(typeOf(type::note, QFont::DemiBold)).size(0, text) + QSizeF(20.0, 10.0);
}

QRectF tagBox(QSizeF size, const std::vector<QPointF>& places, const std::vector<QRectF>& kept) {
  for (QPointF place : places) {
    QRectF box(place, size);
    if (std::none_of(kept.begin(), kept.end(), [&](const QRectF& area) { return area.intersects(box); }))
      return box;
  }
  return {places.front(), size};
}

void drawTag(QPainter& painter, QPointF place, const QString& text, const QColor& colour, bool rightAligned) {
  painter.setFont(typeOf(type::note, QFont::DemiBold));
  QSizeF size = tagSize(text);
  double width = size.width();
  QRectF box(QPointF(rightAligned ? place.x() - width : place.x(), place.y()), size);
  if (painter.hasClipping()) {
    // What is to be read lies where it can be.
    QRectF seen = painter.clipBoundingRect();
    box.moveLeft(std::max(seen.left() + 2.0, std::min(box.left(), seen.right() - width - 2.0)));
  }
  QColor ground = colours(Look::dark).input;
  ground.setAlphaF(0.92f);
  painter.setPen(colours(Look::dark).line);
  painter.setBrush(ground);
  painter.drawRoundedRect(box, 6.0, 6.0);
  painter.setPen(colour);
  painter.drawText(box, Qt::AlignCenter, text);
}

}  // namespace relucent::gui
