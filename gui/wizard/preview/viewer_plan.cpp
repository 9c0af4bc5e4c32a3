// SPDX-License-Identifier: MIT
#include "wizard/preview/viewer_plan.h"

#include <QAccessible>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "theme/accessible_role.h"
#include "theme/theme.h"
#include "views/number_text.h"

namespace relucent::gui {
namespace {

constexpr int planHeight = 170;
constexpr double radius = 9.0, handleReach = 14.0, surfaceAt = 12.0;
constexpr double leastRoom = 4.0, mostRoom = 1000.0;  // metres
constexpr double margin = 1.2;
constexpr double step = 0.1, longStep = 1.0;

}  // namespace

ViewerPlan::ViewerPlan(QWidget* parent) : QWidget(parent) {
  setObjectName("viewer-plan");
  setFixedHeight(planHeight);
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleRole(this, QAccessible::Graphic);
  setAccessibleName(tr("Plan of the cameras and of the viewer, seen from above"));
}

void ViewerPlan::show(const std::vector<compensation::Position>& cameras,
                      const std::optional<compensation::Position>& viewer,
                      const std::vector<double>& shares) {
  cameras_ = cameras;
  viewer_ = viewer;
  shares_ = shares;
  if (active_ >= points()) activate(-1);
  // What is dragged stays under the pointer.
  if (held_ < 0) chooseRoom();
  if (active_ >= 0) setAccessibleDescription(placeText(active_));
  update();
}

int ViewerPlan::points() const {
  return static_cast<int>(cameras_.size()) + (viewer_ ? 1 : 0);
}

compensation::Position ViewerPlan::positionOf(int point) const {
  const auto index = static_cast<std::size_t>(point);
  return index < cameras_.size() ? cameras_[index] : viewer_.value_or(compensation::Position{});
}

void ViewerPlan::chooseRoom() {
  double widest = 0.0;
  for (int point = 0; point < points(); ++point) {
    const compensation::Position position = positionOf(point);
    widest = std::max({widest, std::abs(position[0]), position[1]});
  }
  room_ = std::clamp(margin * widest, leastRoom, mostRoom);
}

QPointF ViewerPlan::widgetFromMetres(const compensation::Position& position) const {
  const double scale = (height() - surfaceAt) / room_;
  return {width() / 2.0 + scale * position[0], surfaceAt + scale * position[1]};
}

compensation::Position ViewerPlan::metresFromWidget(QPointF place) const {
  const double scale = (height() - surfaceAt) / room_;
  const auto rounded = [](double metres) { return std::round(metres / step) * step; };
  const double aside = (std::clamp(place.x(), 0.0, static_cast<double>(width())) - width() / 2.0) / scale;
  const double away = (std::clamp(place.y(), surfaceAt, static_cast<double>(height())) - surfaceAt) / scale;
  return {rounded(aside), rounded(away), 0.0};
}

QPointF ViewerPlan::placeOf(int point) const {
  return widgetFromMetres(positionOf(point));
}

QString ViewerPlan::placeText(int point) const {
  if (point < 0 || point >= points()) return {};
  const compensation::Position position = positionOf(point);
  const QString who =
      static_cast<std::size_t>(point) < cameras_.size() ? tr("Camera %1").arg(point + 1) : tr("Viewer");
  const QString aside = decimalText(std::abs(position[0]), 1), away = decimalText(position[1], 1);
  return (position[0] < 0.0 ? tr("%1: %2 m to the left, %3 m from the surface")
                            : tr("%1: %2 m to the right, %3 m from the surface"))
      .arg(who, aside, away);
}

void ViewerPlan::activate(int point) {
  active_ = point;
  setAccessibleDescription(placeText(point));
  setToolTip(placeText(point));
  QAccessibleEvent event(this, QAccessible::DescriptionChanged);
  QAccessible::updateAccessibility(&event);
  update();
}

void ViewerPlan::move(int point, const compensation::Position& to) {
  if (static_cast<std::size_t>(point) < cameras_.size())
    Q_EMIT cameraMoved(point, to);
  else
    Q_EMIT viewerMoved(to);
}

void ViewerPlan::mousePressEvent(QMouseEvent* event) {
  held_ = -1;
  // The viewer is drawn last, over the cameras.
  for (int point = points() - 1; point >= 0 && held_ < 0; --point)
    if (QLineF(placeOf(point), event->position()).length() < handleReach) held_ = point;
  activate(held_);
}

void ViewerPlan::mouseMoveEvent(QMouseEvent* event) {
  if (held_ >= 0) move(held_, metresFromWidget(event->position()));
}

void ViewerPlan::mouseReleaseEvent(QMouseEvent*) {
  held_ = -1;
  chooseRoom();
  update();
}

void ViewerPlan::keyPressEvent(QKeyEvent* event) {
  if (active_ < 0) return QWidget::keyPressEvent(event);
  const double by = event->modifiers().testFlag(Qt::ShiftModifier) ? longStep : step;
  compensation::Position to = positionOf(active_);
  switch (event->key()) {
    case Qt::Key_Left:
      to[0] -= by;
      break;
    case Qt::Key_Right:
      to[0] += by;
      break;
    case Qt::Key_Up:
      to[1] = std::max(0.0, to[1] - by);
      break;
    case Qt::Key_Down:
      to[1] += by;
      break;
    case Qt::Key_Escape:
      return activate(-1);
    default:
      return QWidget::keyPressEvent(event);
  }
  move(active_, to);
}

void ViewerPlan::focusInEvent(QFocusEvent* event) {
  if (event->reason() == Qt::TabFocusReason && points() > 0) activate(0);
  if (event->reason() == Qt::BacktabFocusReason && points() > 0) activate(points() - 1);
  QWidget::focusInEvent(event);
}

void ViewerPlan::focusOutEvent(QFocusEvent* event) {
  if (event->reason() != Qt::ActiveWindowFocusReason && event->reason() != Qt::PopupFocusReason) activate(-1);
  QWidget::focusOutEvent(event);
}

bool ViewerPlan::focusNextPrevChild(bool next) {
  const int to = active_ + (next ? 1 : -1);
  if (active_ < 0 || to < 0 || to >= points()) return QWidget::focusNextPrevChild(next);
  activate(to);
  return true;
}

void ViewerPlan::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Colours& now = colours();
  painter.setPen(QPen(now.line, 1.0));
  painter.setBrush(now.input);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6);
  // The surface.
  painter.setPen(QPen(now.secondary, 3.0));
  painter.drawLine(QPointF(width() * 0.25, surfaceAt), QPointF(width() * 0.75, surfaceAt));
  if (viewer_)
    for (std::size_t camera = 0; camera < shares_.size() && camera < cameras_.size(); ++camera) {
      if (!(shares_[camera] > 0.005)) continue;
      painter.setPen(QPen(now.accent, 1.0 + 4.0 * shares_[camera], Qt::DotLine));
      painter.drawLine(widgetFromMetres(*viewer_), widgetFromMetres(cameras_[camera]));
    }
  painter.setFont(typeOf(type::note, QFont::DemiBold));
  for (int point = 0; point < points(); ++point) {
    const bool isCamera = static_cast<std::size_t>(point) < cameras_.size();
    const QPointF place = placeOf(point);
    if (point == active_) {
      painter.setPen(QPen(now.text, 2.0));
      painter.setBrush(Qt::NoBrush);
      painter.drawEllipse(place, radius + 4.0, radius + 4.0);
    }
    painter.setPen(QPen(isCamera ? now.border : now.accent, 1.5));
    painter.setBrush(isCamera ? now.raised : now.accent);
    painter.drawEllipse(place, radius, radius);
    painter.setPen(isCamera ? now.text : now.onAccent);
    const QRectF box(place - QPointF(radius, radius), QSizeF(2 * radius, 2 * radius));
    if (isCamera) painter.drawText(box, Qt::AlignCenter, QString::number(point + 1));
  }
}

}  // namespace relucent::gui
