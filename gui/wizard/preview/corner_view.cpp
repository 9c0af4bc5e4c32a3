// SPDX-License-Identifier: MIT
#include "wizard/preview/corner_view.h"

#include <QAccessible>
#include <QKeyEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "theme/theme.h"
#include "views/view_tag.h"

namespace relucent::gui {
namespace {

constexpr double handleRadius = 7.0, activeRadius = 11.0, grip = 14.0, dividerStep = 0.1;
constexpr double fromEdge = 12.0;
constexpr int cornerCount = 4;

}  // namespace

CornerView::CornerView(QWidget* parent) : ImageView(parent) {}

void CornerView::setCorners(const std::optional<compensation::Corners>& wanted) {
  if (wanted == corners_) return;
  corners_ = wanted;
  if (active_ >= 0) activate(corners_ ? active_ : -1);
  update();
}

void CornerView::setWrong(bool wrong) {
  wrong_ = wrong;
  update();
}

QString CornerView::cornerText(int corner) const {
  if (!corners_ || corner < 0) return {};
  const auto& place = (*corners_)[static_cast<std::size_t>(corner)];
  const QString names[] = {tr("Top left corner, %1, %2."), tr("Top right corner, %1, %2."),
                           tr("Bottom right corner, %1, %2."), tr("Bottom left corner, %1, %2.")};
  return names[corner].arg(std::lround(place[0])).arg(std::lround(place[1]));
}

void CornerView::activate(int corner) {
  active_ = corner;
  setAccessibleDescription(cornerText(corner));
  QAccessibleEvent event(this, QAccessible::DescriptionChanged);
  QAccessible::updateAccessibility(&event);
  update();
}

QPointF CornerView::handle(int corner) const {
  const auto& place = (dragged_ ? *dragged_ : *corners_)[static_cast<std::size_t>(corner)];
  return widgetFromPicture({place[0], place[1]});
}

QRectF CornerView::handleArea(int corner) const {
  QPointF reach(activeRadius, activeRadius);
  return {handle(corner) - reach, handle(corner) + reach};
}

std::vector<QRectF> CornerView::keptFree() const {
  std::vector<QRectF> kept;
  for (int corner = 0; corners_ && corner < cornerCount; ++corner) kept.push_back(handleArea(corner));
  return kept;
}

QRectF CornerView::cornerTag() const {
  QSizeF size = tagSize(cornerText(active_));
  double right = width() - fromEdge - size.width(), lower = height() - fromEdge - size.height();
  std::vector<QRectF> kept = keptFree();
  for (bool atRight : {false, true}) kept.push_back(dividerTag(atRight));
  return tagBox(size, {{fromEdge, lower}, {right, lower}, {fromEdge, fromEdge}, {right, fromEdge}}, kept);
}

int CornerView::handleAt(QPointF place) const {
  if (!corners_ || picture().isNull()) return -1;
  for (int corner = 0; corner < cornerCount; ++corner)
    if (QLineF(handle(corner), place).length() < grip) return corner;
  return -1;
}

compensation::Corners CornerView::with(int corner, QPointF place) const {
  compensation::Corners changed = *corners_;
  changed[static_cast<std::size_t>(corner)] = {
      std::clamp(place.x(), 0.0, static_cast<double>(picture().width())),
      std::clamp(place.y(), 0.0, static_cast<double>(picture().height()))};
  return changed;
}

void CornerView::mousePressEvent(QMouseEvent* event) {
  held_ = event->button() == Qt::LeftButton ? handleAt(event->position()) : -1;
  if (held_ < 0) {
    activate(-1);
    return ImageView::mousePressEvent(event);
  }
  activate(held_);
}

void CornerView::mouseMoveEvent(QMouseEvent* event) {
  if (held_ < 0) {
    setCursor(handleAt(event->position()) >= 0 ? Qt::SizeAllCursor : Qt::ArrowCursor);
    return ImageView::mouseMoveEvent(event);
  }
  dragged_ = with(held_, pictureFromWidget(event->position()));
  update();
  Q_EMIT moved(*dragged_);
}

void CornerView::mouseReleaseEvent(QMouseEvent* event) {
  if (held_ < 0) return ImageView::mouseReleaseEvent(event);
  held_ = -1;
  dragged_.reset();
  update();
  Q_EMIT released();
}

void CornerView::keyPressEvent(QKeyEvent* event) {
  double step = event->modifiers().testFlag(Qt::ShiftModifier) ? 10.0 : 1.0;
  if (event->key() == Qt::Key_D) {
    double there = divider() + (step > 1.0 ? -dividerStep : dividerStep);
    // Beyond an end it begins at the other.
    return setDivider(there > 1.0 + dividerStep / 2.0 ? 0.0 : there < -dividerStep / 2.0 ? 1.0 : there);
  }
  if (active_ < 0 || !corners_) return ImageView::keyPressEvent(event);
  QPointF by;
  switch (event->key()) {
    case Qt::Key_Left:
      by = {-step, 0.0};
      break;
    case Qt::Key_Right:
      by = {step, 0.0};
      break;
    case Qt::Key_Up:
      by = {0.0, -step};
      break;
    case Qt::Key_Down:
      by = {0.0, step};
      break;
    case Qt::Key_Escape:
      return activate(-1);
    default:
      return ImageView::keyPressEvent(event);
  }
  const auto& place = (*corners_)[static_cast<std::size_t>(active_)];
  Q_EMIT moved(with(active_, QPointF(place[0], place[1]) + by));
}

void CornerView::focusInEvent(QFocusEvent* event) {
  if (corners_ && event->reason() == Qt::TabFocusReason) activate(0);
  if (corners_ && event->reason() == Qt::BacktabFocusReason) activate(cornerCount - 1);
  ImageView::focusInEvent(event);
}

void CornerView::focusOutEvent(QFocusEvent* event) {
  if (event->reason() != Qt::ActiveWindowFocusReason && event->reason() != Qt::PopupFocusReason) activate(-1);
  ImageView::focusOutEvent(event);
}

bool CornerView::focusNextPrevChild(bool next) {
  int to = active_ + (next ? 1 : -1);
  if (!corners_ || active_ < 0 || to < 0 || to >= cornerCount) return ImageView::focusNextPrevChild(next);
  activate(to);
  return true;
}

void CornerView::paintEvent(QPaintEvent* event) {
  ImageView::paintEvent(event);
  if (!corners_ || picture().isNull()) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Colours& dark = gui::colours(Look::dark);
  const QColor& colour = wrong_ ? dark.amber : dark.accent;
  QPolygonF outline;
  for (int corner = 0; corner < cornerCount; ++corner) outline.append(handle(corner));
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(colour, 1.5, wrong_ ? Qt::DashLine : Qt::SolidLine));
  painter.drawPolygon(outline);
  for (int corner = 0; corner < cornerCount; ++corner) {
    painter.setPen(QPen(dark.picture, 1.5));
    painter.setBrush(colour);
    painter.drawEllipse(handle(corner), handleRadius, handleRadius);
    if (corner != active_) continue;
    painter.setPen(QPen(dark.text, 2.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(handle(corner), activeRadius, activeRadius);
  }
  if (active_ >= 0) drawTag(painter, cornerTag().topLeft(), cornerText(active_), dark.text);
}

}  // namespace relucent::gui
