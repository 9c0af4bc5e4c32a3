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

std::optional<QPointF> PlaneView::placeOfPick() const {
  const std::optional<QPoint> pick = link_->pick();
  if (!pick || !QRect(QPoint(), planeSize()).contains(*pick)) return std::nullopt;
  const QPointF place = widgetFromPicture(QPointF(*pick) + QPointF(0.5, 0.5));
  return frame().contains(place) ? std::optional(place) : std::nullopt;
}

/// On the plane where that is wide enough, else anywhere in the view: words are never cut.
QRectF PlaneView::roomForTag(const QString& text) const {
  constexpr double margins = 4.0;
  const QSizeF needed = tagSize(text) + QSizeF(margins, margins);
  const bool isRoomy = frame().width() >= needed.width() && frame().height() >= needed.height();
  return isRoomy ? frame() : QRectF(rect());
}

void PlaneView::paintTag(QPainter& painter, QPointF topLeft, const QString& text, const QColor& colour,
                         bool rightAligned) {
  painter.save();
  painter.setClipRect(roomForTag(text), Qt::IntersectClip);
  drawTag(painter, topLeft, text, colour, rightAligned);
  painter.restore();
}

void PlaneView::paintCrossOfPick(QPainter& painter) {
  const std::optional<QPointF> at = placeOfPick();
  if (!at) return;
  const QPointF place = *at;
  for (auto [colour, width] : {std::pair(darkColours().picture, 4.0), std::pair(darkColours().accent, 2.0)}) {
    painter.setPen(QPen(colour, width));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(place, 7.0, 7.0);
    for (QPointF step : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
      painter.drawLine(place + 7.0 * step, place + 15.0 * step);
  }
}

void PlaneView::paintPickReadout(QPainter& painter) {
  const std::optional<QPointF> at = placeOfPick();
  if (!at || !readout_) return;
  const QString text = readout_(*link_->pick());
  if (text.isEmpty()) return;
  const QPointF place = *at;
  const QRectF room = roomForTag(text);
  bool right = place.x() > room.center().x();
  const QSizeF size = tagSize(text);
  bool above = place.y() > room.top() + size.height() + 24.0;
  std::vector<QPointF> places;
  for (auto [toLeft, upwards] : {std::pair(right, above), std::pair(right, !above), std::pair(!right, above),
                                 std::pair(!right, !above)}) {
    QPointF corner(toLeft ? place.x() - size.width() - 12.0 : place.x() + 12.0,
                   upwards ? place.y() - size.height() - 20.0 : place.y() + 20.0);
    corner.setX(std::clamp(corner.x(), room.left(), std::max(room.left(), room.right() - size.width())));
    if (room.contains(QRectF(corner, size))) places.push_back(corner);
  }
  // Beside or over the pick rather than cut.
  if (places.empty())
    places.emplace_back(
        std::clamp(place.x() + 12.0, room.left(), std::max(room.left(), room.right() - size.width())),
        std::clamp(place.y() + 20.0, room.top(), std::max(room.top(), room.bottom() - size.height())));
  paintTag(painter, tagBox(size, places, keptFree()).topLeft(), text, darkColours().text);
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
  if (isWholeScreen()) {
    const QSizeF size = tagSize(tr("Esc goes back"));
    // Below what may stand at the top, at the sides of a divider.
    drawTag(painter, {rect().center().x() - size.width() / 2.0, 12.0 + size.height() + 12.0},
            tr("Esc goes back"), darkColours().secondary);
  }
  if (!hasFocus()) return;
  painter.setPen(QPen(darkColours().text, 2.0));
  painter.setBrush(Qt::NoBrush);
  painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), cornerRadius, cornerRadius);
}

void PlaneView::paintMarks(QPainter& painter) {
  painter.save();
  painter.setClipRect(frame(), Qt::IntersectClip);
  if (scaleBar_) paintScaleBar(painter);
  paintCrossOfPick(painter);
  painter.restore();
  paintPickReadout(painter);
  if (!badge_.isEmpty())
    paintTag(painter, frame().topLeft() + QPointF(12.0, 12.0), badge_, darkColours().amber);
  if (!caption_.isEmpty())
    paintTag(painter, frame().bottomLeft() + QPointF(12.0, -12.0 - tagSize(caption_).height()), caption_,
             darkColours().text);
  if (hovered_ && readout_ && hovered_ != link_->pick())
    if (QString text = readout_(*hovered_); !text.isEmpty())
      paintTag(painter, frame().bottomRight() - QPointF(12.0, 12.0 + tagSize(text).height()), text,
               darkColours().text, true);
}

}  // namespace relucent::gui
