// SPDX-License-Identifier: MIT
#include "wizard/preview/mask_view.h"

#include <QAccessible>
#include <QKeyEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "theme/theme.h"
#include "views/view_tag.h"

namespace relucent::gui {
namespace {

constexpr double pointRadius = 6.0, activePointRadius = 10.0, pointGrip = 14.0, crossSize = 9.0;

bool isArrow(int key) {
  return key == Qt::Key_Left || key == Qt::Key_Right || key == Qt::Key_Up || key == Qt::Key_Down;
}

}  // namespace

void MaskView::setMasks(const std::vector<compensation::Mask>& masks, int chosen) {
  if (masks == masks_ && chosen == chosen_) return;
  if (chosen != chosen_) point_ = -1;
  masks_ = masks;
  chosen_ = chosen;
  if (const compensation::Mask* mask = this->chosen(); mask == nullptr || point_ >= std::ssize(mask->points))
    point_ = -1;
  tell();
}

void MaskView::setDrawing(bool drawing, compensation::Outline outline) {
  outline_ = outline;
  if (drawing != drawing_) {
    drawing_ = drawing;
    drawn_.clear();
    cursor_ = {0.5, 0.5};
    tell();
  }
  update();
}

const compensation::Mask* MaskView::chosen() const {
  return chosen_ >= 0 && chosen_ < std::ssize(masks_) ? &masks_[static_cast<std::size_t>(chosen_)] : nullptr;
}

QPointF MaskView::widgetFromMask(const std::array<double, 2>& point) const {
  return widgetFromPicture({point[0] * picture().width(), point[1] * picture().height()});
}

std::array<double, 2> MaskView::maskFromWidget(QPointF place) const {
  const QPointF at = pictureFromWidget(place);
  return {std::clamp(at.x() / picture().width(), 0.0, 1.0),
          std::clamp(at.y() / picture().height(), 0.0, 1.0)};
}

QString MaskView::pointText() const {
  const auto placed = [this](const std::array<double, 2>& point) {
    return std::pair(std::lround(point[0] * picture().width()), std::lround(point[1] * picture().height()));
  };
  if (drawing_) {
    const auto [x, y] = placed(cursor_);
    return tr("Drawing a mask: %n point(s). Space sets one at %1, %2. Return closes it, Escape leaves it.",
              nullptr, static_cast<int>(drawn_.size()))
        .arg(x)
        .arg(y);
  }
  const compensation::Mask* mask = chosen();
  if (mask == nullptr || point_ < 0) return {};
  const auto [x, y] = placed(mask->points[static_cast<std::size_t>(point_)]);
  return tr("Point %1 of %2, %3, %4.").arg(point_ + 1).arg(mask->points.size()).arg(x).arg(y);
}

void MaskView::tell() {
  if (drawing_ || point_ >= 0) setAccessibleDescription(pointText());
  QAccessibleEvent event(this, QAccessible::DescriptionChanged);
  QAccessible::updateAccessibility(&event);
  update();
}

void MaskView::activate(int point) {
  point_ = point;
  tell();
}

QPolygonF MaskView::outlineOf(const compensation::Mask& mask) const {
  QPolygonF outline;
  for (const auto& point : mask.points.size() < 3 ? mask.points : compensation::outlineOf(mask))
    outline.append(widgetFromMask(point));
  return outline;
}

int MaskView::pointAt(const Points& points, QPointF place) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (QLineF(widgetFromMask(points[i]), place).length() < pointGrip) return static_cast<int>(i);
  return -1;
}

int MaskView::maskAt(QPointF place) const {
  for (std::size_t i = masks_.size(); i-- > 0;)
    if (outlineOf(masks_[i]).containsPoint(place, Qt::OddEvenFill)) return static_cast<int>(i);
  return -1;
}

std::vector<QRectF> MaskView::keptFree() const {
  std::vector<QRectF> kept = CornerView::keptFree();
  const compensation::Mask* mask = chosen();
  const QPointF reach(activePointRadius, activePointRadius);
  for (const auto& point : mask != nullptr ? mask->points : drawn_)
    kept.push_back({widgetFromMask(point) - reach, widgetFromMask(point) + reach});
  return kept;
}

void MaskView::addPoint(const std::array<double, 2>& point) {
  // A second click on the same place is none, nor is one on the first point before there are three.
  const auto isAt = [&](const std::array<double, 2>& other) {
    return QLineF(widgetFromMask(other), widgetFromMask(point)).length() < 2.0;
  };
  if (!drawn_.empty() && (isAt(drawn_.back()) || isAt(drawn_.front()))) return;
  if (drawn_.size() < compensation::mostMaskPoints) drawn_.push_back(point);
  tell();
}

void MaskView::close() {
  // The owner ends the drawing, which forgets the points.
  const Points points = drawn_;
  Q_EMIT closed(points);
}

void MaskView::mousePressEvent(QMouseEvent* event) {
  if (picture().isNull() || event->button() != Qt::LeftButton) return CornerView::mousePressEvent(event);
  const QPointF place = event->position();
  if (drawing_) {
    if (drawn_.size() >= 3 && QLineF(widgetFromMask(drawn_.front()), place).length() < pointGrip)
      return close();
    cursor_ = maskFromWidget(place);
    return addPoint(cursor_);
  }
  if (const compensation::Mask* mask = chosen()) {
    held_ = pointAt(mask->points, place);
    if (held_ >= 0) return activate(held_);
  }
  activate(-1);
  if (const int mask = maskAt(place); mask >= 0 && mask != chosen_) Q_EMIT picked(mask);
  CornerView::mousePressEvent(event);
}

void MaskView::mouseMoveEvent(QMouseEvent* event) {
  if (drawing_) {
    setCursor(Qt::CrossCursor);
    if (!picture().isNull()) cursor_ = maskFromWidget(event->position());
    return update();
  }
  const compensation::Mask* mask = chosen();
  if (held_ < 0 || mask == nullptr || held_ >= std::ssize(mask->points))
    return CornerView::mouseMoveEvent(event);
  Points points = mask->points;
  points[static_cast<std::size_t>(held_)] = maskFromWidget(event->position());
  Q_EMIT pointsMoved(chosen_, points);
}

void MaskView::mouseReleaseEvent(QMouseEvent* event) {
  if (drawing_) return;
  if (held_ < 0) return CornerView::mouseReleaseEvent(event);
  held_ = -1;
}

void MaskView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (!drawing_) return CornerView::mouseDoubleClickEvent(event);
  if (drawn_.size() >= 3) close();
}

std::array<double, 2> MaskView::step(std::array<double, 2> from, int key, bool far) const {
  const double pixels = far ? 10.0 : 1.0;
  const double x = key == Qt::Key_Left ? -pixels : key == Qt::Key_Right ? pixels : 0.0;
  const double y = key == Qt::Key_Up ? -pixels : key == Qt::Key_Down ? pixels : 0.0;
  return {std::clamp(from[0] + x / picture().width(), 0.0, 1.0),
          std::clamp(from[1] + y / picture().height(), 0.0, 1.0)};
}

void MaskView::drawByKey(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Space:
      return addPoint(cursor_);
    case Qt::Key_Return:
    case Qt::Key_Enter:
      return close();
    case Qt::Key_Escape:
      return Q_EMIT cancelled();
    case Qt::Key_Backspace:
    case Qt::Key_Delete:
      if (!drawn_.empty()) drawn_.pop_back();
      return tell();
    default:
      if (!isArrow(event->key())) return CornerView::keyPressEvent(event);
      cursor_ = step(cursor_, event->key(), event->modifiers().testFlag(Qt::ShiftModifier));
      tell();
  }
}

void MaskView::removePoint() {
  Points points = chosen()->points;
  if (point_ < 0 || points.size() <= 3) return Q_EMIT removed(chosen_);
  points.erase(points.begin() + point_);
  activate(-1);
  Q_EMIT pointsMoved(chosen_, points);
}

void MaskView::keyPressEvent(QKeyEvent* event) {
  if (picture().isNull()) return CornerView::keyPressEvent(event);
  if (drawing_) return drawByKey(event);
  const compensation::Mask* mask = chosen();
  if (mask == nullptr) return CornerView::keyPressEvent(event);
  if (event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace) return removePoint();
  if (event->key() == Qt::Key_Escape) {
    if (point_ >= 0) return activate(-1);
    return Q_EMIT picked(-1);
  }
  if (point_ < 0 || !isArrow(event->key())) return CornerView::keyPressEvent(event);
  Points points = mask->points;
  auto& moved = points[static_cast<std::size_t>(point_)];
  moved = step(moved, event->key(), event->modifiers().testFlag(Qt::ShiftModifier));
  Q_EMIT pointsMoved(chosen_, points);
}

bool MaskView::event(QEvent* event) {
  // While a mask is drawn or chosen these are its keys, not those of the page's commands.
  if (event->type() == QEvent::ShortcutOverride && (drawing_ || chosen() != nullptr)) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    const bool edits =
        isArrow(key) || key == Qt::Key_Delete || key == Qt::Key_Backspace || key == Qt::Key_Escape;
    if (edits || (drawing_ && (key == Qt::Key_Space || key == Qt::Key_Return || key == Qt::Key_Enter))) {
      event->accept();
      return true;
    }
  }
  return CornerView::event(event);
}

void MaskView::focusInEvent(QFocusEvent* event) {
  const compensation::Mask* mask = chosen();
  if (!drawing_ && mask == nullptr) return CornerView::focusInEvent(event);
  const auto last = mask != nullptr ? static_cast<int>(mask->points.size()) - 1 : -1;
  if (mask != nullptr && event->reason() == Qt::TabFocusReason) activate(0);
  if (mask != nullptr && event->reason() == Qt::BacktabFocusReason) activate(last);
  ImageView::focusInEvent(event);  // NOLINT(bugprone-parent-virtual-call): corners are not what is seen
}

bool MaskView::focusNextPrevChild(bool next) {
  const compensation::Mask* mask = chosen();
  if (drawing_ || mask == nullptr) return CornerView::focusNextPrevChild(next);
  const int to = point_ < 0 ? (next ? 0 : -2) : point_ + (next ? 1 : -1);
  if (to < 0 || to >= std::ssize(mask->points)) {
    activate(-1);
    return ImageView::focusNextPrevChild(next);  // NOLINT(bugprone-parent-virtual-call): as above
  }
  activate(to);
  return true;
}

void MaskView::paintEvent(QPaintEvent* event) {
  CornerView::paintEvent(event);
  if (picture().isNull() || (masks_.empty() && !drawing_)) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Colours& dark = gui::colours(Look::dark);
  const auto drawPoints = [&](const Points& points, int active) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      painter.setPen(QPen(dark.picture, 1.5));
      painter.setBrush(dark.amber);
      painter.drawEllipse(widgetFromMask(points[i]), pointRadius, pointRadius);
      if (static_cast<int>(i) != active) continue;
      painter.setPen(QPen(dark.text, 2.0));
      painter.setBrush(Qt::NoBrush);
      painter.drawEllipse(widgetFromMask(points[i]), activePointRadius, activePointRadius);
    }
  };
  for (std::size_t i = 0; i < masks_.size(); ++i) {
    const bool isChosen = static_cast<int>(i) == chosen_;
    painter.setPen(QPen(dark.amber, isChosen ? 2.0 : 1.0));
    painter.setBrush(QBrush(dark.amber, Qt::BDiagPattern));
    painter.drawPolygon(outlineOf(masks_[i]));
    if (isChosen && !drawing_) drawPoints(masks_[i].points, point_);
  }
  if (drawing_) {
    painter.setPen(QPen(dark.amber, 2.0, Qt::DashLine));
    painter.setBrush(Qt::NoBrush);
    compensation::Mask sketch{0, outline_, drawn_, 0.0};
    if (drawn_.size() < 3)
      painter.drawPolyline(outlineOf(sketch));
    else
      painter.drawPolygon(outlineOf(sketch));
    drawPoints(drawn_, -1);
    const QPointF at = widgetFromMask(cursor_);
    painter.setPen(QPen(dark.text, 1.5));
    painter.drawLine(at - QPointF(crossSize, 0.0), at + QPointF(crossSize, 0.0));
    painter.drawLine(at - QPointF(0.0, crossSize), at + QPointF(0.0, crossSize));
  }
}

}  // namespace relucent::gui
