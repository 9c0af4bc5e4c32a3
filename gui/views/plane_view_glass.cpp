// SPDX-License-Identifier: MIT
// What stands over a plane: pick, readouts, scale bar, badge, focus.
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "theme/theme.h"
#include "views/plane_view.h"
#include "views/view_tag.h"

namespace relucent::gui {
void PlaneView::paintPick(QPainter& painter) {
  std::optional<QPoint> pick = link_->pick();
  if (!pick || !QRect(QPoint(), planeSize()).contains(*pick)) return;
  QPointF place = widgetFromPicture(QPointF(*pick) + QPointF(0.5, 0.5));
  if (!frame().contains(place)) return;
  for (auto [colour, width] : {std::pair(darkColours().picture, 4.0), std::pair(darkColours().accent, 2.0)}) {
    painter.setPen(QPen(colour, width));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(place, 7.0, 7.0);
    for (QPointF step : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
      painter.drawLine(place + 7.0 * step, place + 15.0 * step);
  }
  if (!readout_) return;
  QString text = readout_(*pick);
  if (text.isEmpty()) return;
  bool right = place.x() > frame().center().x();
  const QSizeF size = tagSize(text);
  bool above = place.y() > frame().top() + size.height() + 24.0;
  std::vector<QPointF> places;
  for (auto [toLeft, upwards] : {std::pair(right, above), std::pair(right, !above), std::pair(!right, above),
                                 std::pair(!right, !above)}) {
    QPointF corner(toLeft ? place.x() - size.width() - 12.0 : place.x() + 12.0,
                   upwards ? place.y() - size.height() - 20.0 : place.y() + 20.0);
    corner.setX(
        std::clamp(corner.x(), frame().left(), std::max(frame().left(), frame().right() - size.width())));
    if (places.empty() || frame().contains(QRectF(corner, size))) places.push_back(corner);
  }
  drawTag(painter, tagBox(size, places, keptFree()).topLeft(), text, darkColours().text);
}

void PlaneView::paintScaleBar(QPainter& painter) {
  double pixel = fit().width() * link_->zoom();
  double wanted = 70.0 / pixel;
  double power = std::pow(10.0, std::floor(std::log10(std::max(wanted, 1.0))));
  double length = wanted >= 5.0 * power ? 5.0 * power : wanted >= 2.0 * power ? 2.0 * power : power;
  QRectF box(frame().left() + 12.0, frame().bottom() - 46.0, length * pixel + 24.0, 34.0);
  if (box.right() > frame().right()) return;
  QColor ground = darkColours().input;
  ground.setAlphaF(0.85f);
  painter.setPen(Qt::NoPen);
  painter.setBrush(ground);
  painter.drawRoundedRect(box, 6.0, 6.0);
  painter.setFont(typeOf(type::axis, QFont::DemiBold));
  painter.setPen(darkColours().text);
  painter.drawText(box.adjusted(0, 3, 0, -12), Qt::AlignCenter, tr("%1 px").arg(length));
  painter.drawLine(QPointF(box.left() + 12.0, box.bottom() - 8.0),
                   QPointF(box.right() - 12.0, box.bottom() - 8.0));
}

/// Everything but the plane itself.
void PlaneView::paintWords(QPainter& painter) {
  if (planeSize().isEmpty()) {
    painter.setPen(darkColours().secondary);
    painter.setFont(typeOf(type::body));
    painter.drawText(QRectF(rect()).adjusted(24, 24, -24, -24), Qt::AlignCenter | Qt::TextWordWrap,
                     emptyText_);
  } else {
    paintOver(painter);
    if (isFlat()) paintMarks(painter);
  }
  if (saving_) return;
  if (isWholeScreen())
    drawTag(painter, {rect().center().x() - tagSize(tr("Esc goes back")).width() / 2.0, 12.0},
            tr("Esc goes back"), darkColours().secondary);
  if (!hasFocus()) return;
  painter.setPen(QPen(darkColours().text, 2.0));
  painter.setBrush(Qt::NoBrush);
  painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), cornerRadius, cornerRadius);
}

void PlaneView::paintMarks(QPainter& painter) {
  painter.save();
  painter.setClipRect(frame(), Qt::IntersectClip);
  if (scaleBar_) paintScaleBar(painter);
  paintPick(painter);
  if (!badge_.isEmpty())
    drawTag(painter, frame().topLeft() + QPointF(12.0, 12.0), badge_, darkColours().amber);
  if (!caption_.isEmpty())
    drawTag(painter, frame().bottomLeft() + QPointF(12.0, -12.0 - tagSize(caption_).height()), caption_,
            darkColours().text);
  if (hovered_ && readout_ && hovered_ != link_->pick())
    if (QString text = readout_(*hovered_); !text.isEmpty())
      drawTag(painter, frame().bottomRight() - QPointF(12.0, 12.0 + tagSize(text).height()), text,
              darkColours().text, true);
  painter.restore();
}

}  // namespace relucent::gui
