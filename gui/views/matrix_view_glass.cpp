// SPDX-License-Identifier: MIT
// What stands over the scene of a MatrixView: axes, cross, lens, words of the colour bar.
#include <QPainter>
#include <algorithm>

#include "theme/theme.h"
#include "views/colour_bar.h"
#include "views/matrix_view.h"
#include "views/raster_axis.h"

namespace relucent::gui {
void MatrixView::paintOver(QPainter& painter) {
  paintAxes(painter);
  paintCross(painter);
  paintLens(painter);
  drawColourBarWords(painter, barArea(), scale_, tr("transport"), false);
}

void MatrixView::paintAxes(QPainter& painter) const {
  QRectF area = frame(), part = looked();
  painter.setFont(typeOf(type::axis));
  painter.setPen(darkColours().line);
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(area);
  const Rasters &cameras = matrix_->transport().cameras(), &projectors = matrix_->transport().projectors();
  painter.setPen(darkColours().text);
  double ascent = painter.fontMetrics().height();
  for (const RasterTick& tick :
       rasterTicks(cameras, part.top(), part.bottom(), std::max(2, static_cast<int>(area.height()) / 48))) {
    double y = widgetFromPicture({0.0, tick.place}).y();
    painter.drawLine(QPointF(area.left() - 4.0, y), QPointF(area.left(), y));
    painter.drawText(
        QRectF(0.0, std::clamp(y - ascent / 2.0, 0.0, height() - ascent), area.left() - 7.0, ascent),
        Qt::AlignAbsolute | Qt::AlignRight | Qt::AlignVCenter, tick.text);
  }
  double next = 0.0;
  for (const RasterTick& tick :
       rasterTicks(projectors, part.left(), part.right(), std::max(2, static_cast<int>(area.width()) / 72))) {
    double x = widgetFromPicture({tick.place, 0.0}).x();
    double half = painter.fontMetrics().horizontalAdvance(tick.text) / 2.0 + 4.0;
    if (x - half < next) continue;
    next = x + half;
    painter.drawLine(QPointF(x, area.bottom()), QPointF(x, area.bottom() + 4.0));
    painter.drawText(QRectF(x - half, area.bottom() + 4.0, 2.0 * half, ascent), Qt::AlignCenter, tick.text);
  }
  painter.setPen(darkColours().secondary);
  QString across =
      part.width() < 2.0 * projectors.size(0).width ? tr("projector x, y") : tr("projector line");
  QString down = part.height() < 2.0 * cameras.size(0).width ? tr("camera x, y") : tr("camera line");
  // In the middle, and in long languages as wide as the view.
  const QString title = tr("%1 across, %2 down").arg(across, down);
  const double advance = painter.fontMetrics().horizontalAdvance(title) + 2.0;
  const double left = std::clamp(area.center().x() - advance / 2.0, 0.0, std::max(0.0, width() - advance));
  painter.drawText(QRectF(left, height() - ascent - 1.0, advance, ascent), Qt::AlignCenter, title);
}

void MatrixView::paintLens(QPainter& painter) const {
  if (!hasLens()) return;
  QRectF lens = lensFrame(), box = targetOf(shown_.lens.density->part);
  painter.setPen(QPen(darkColours().text, 1.2));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(box);
  painter.drawRect(lens);
  bool above = lens.center().y() < box.center().y();
  painter.drawLine(above ? lens.bottomLeft() : lens.topLeft(), above ? box.topLeft() : box.bottomLeft());
  painter.drawLine(above ? lens.bottomRight() : lens.topRight(), above ? box.topRight() : box.bottomRight());
}

void MatrixView::paintCross(QPainter& painter) const {
  std::optional<QPoint> pick = link().pick();
  if (!pick) return;
  QPointF place = widgetFromPicture(QPointF(*pick) + QPointF(0.5, 0.5));
  QRectF area = frame();
  QColor faint = darkColours().accent;
  faint.setAlphaF(0.55f);
  if (place.y() > area.top() && place.y() < area.bottom()) {
    painter.setPen(QPen(darkColours().accent, 1.4));
    painter.drawLine(QPointF(area.left(), place.y()), QPointF(area.right(), place.y()));
  }
  if (place.x() > area.left() && place.x() < area.right()) {
    painter.setPen(QPen(faint, 1.0));
    painter.drawLine(QPointF(place.x(), area.top()), QPointF(place.x(), area.bottom()));
  }
}

}  // namespace relucent::gui
