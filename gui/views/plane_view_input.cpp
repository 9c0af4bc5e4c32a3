// SPDX-License-Identifier: MIT
// What mouse, wheel and keys do to a PlaneView.
#include <QKeyEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "views/plane_view.h"

namespace relucent::gui {
namespace {

constexpr double clickSlop = 4.0;

}  // namespace

void PlaneView::zoomAt(QPointF place, double factor) {
  if (planeSize().isEmpty()) return;
  QRectF before = target();
  QPointF share((place.x() - before.left()) / before.width(), (place.y() - before.top()) / before.height());
  double zoom = std::clamp(link_->zoom() * factor, 1.0, link_->mostZoom());
  QSizeF size(before.width() * zoom / link_->zoom(), before.height() * zoom / link_->zoom());
  // The same place of the plane stays under the pointer.
  QPointF centre(share.x() + (frame().center().x() - place.x()) / size.width(),
                 share.y() + (frame().center().y() - place.y()) / size.height());
  look(zoom, centre);
}

void PlaneView::wheelEvent(QWheelEvent* event) {
  zoomAt(event->position(), std::pow(1.2, event->angleDelta().y() / 120.0));
  event->accept();
}

void PlaneView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  pressed_ = lastDrag_ = event->position();
  dragging_ = true;
}

void PlaneView::mouseMoveEvent(QMouseEvent* event) {
  if (std::optional<QPoint> under = pixelAt(event->position()); under != hovered_) {
    hovered_ = under;
    refreshWords();
  }
  if (!dragging_ || planeSize().isEmpty()) return;
  QPointF step = event->position() - lastDrag_;
  lastDrag_ = event->position();
  QRectF whole = target();
  look(link_->zoom(), link_->centre() - QPointF(step.x() / whole.width(), step.y() / whole.height()));
}

void PlaneView::mouseReleaseEvent(QMouseEvent* event) {
  bool click = (event->position() - pressed_).manhattanLength() < clickSlop;
  if (std::exchange(dragging_, false) && click)
    if (std::optional<QPoint> pixel = pixelAt(event->position())) link_->setPick(pixel);
}

void PlaneView::mouseDoubleClickEvent(QMouseEvent*) {
  look(1.0, {0.5, 0.5});
}

bool PlaneView::event(QEvent* event) {
  // Before the window, whose key it is as well, and before what a subclass does with its keys.
  if (event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress) {
    int key = static_cast<QKeyEvent*>(event)->key();
    bool inLayout = parentWidget() != nullptr && parentWidget()->layout() != nullptr;
    if (inLayout && (key == Qt::Key_F11 || (isWholeScreen() && key == Qt::Key_Escape))) {
      event->accept();
      if (event->type() == QEvent::KeyPress) setWholeScreen(!isWholeScreen());
      return true;
    }
  }
  if (event->type() == QEvent::Leave && hovered_) {
    hovered_.reset();
    refresh();
  }
  if (event->type() == QEvent::FocusIn || event->type() == QEvent::FocusOut || event->type() == QEvent::Show)
    refresh();
  return QWidget::event(event);
}

void PlaneView::movePick(int dx, int dy) {
  if (planeSize().isEmpty()) return;
  QRect plane(QPoint(), planeSize());
  QPoint from = link_->pick().value_or(plane.center());
  QPoint to(std::clamp(from.x() + dx, 0, plane.width() - 1),
            std::clamp(from.y() + dy, 0, plane.height() - 1));
  link_->setPick(to);
}

void PlaneView::keyPressEvent(QKeyEvent* event) {
  QPointF middle = frame().center();
  int step = event->modifiers().testFlag(Qt::ShiftModifier) ? 10 : 1;
  switch (event->key()) {
    case Qt::Key_0:
      return look(1.0, {0.5, 0.5});
    case Qt::Key_1:
      return look(1.0 / (std::min(fit().width(), fit().height()) * devicePixelRatioF()), link_->centre());
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      return zoomAt(middle, 1.5);
    case Qt::Key_Minus:
      return zoomAt(middle, 1.0 / 1.5);
    case Qt::Key_Left:
      return movePick(-step, 0);
    case Qt::Key_Right:
      return movePick(step, 0);
    case Qt::Key_Up:
      return movePick(0, -step);
    case Qt::Key_Down:
      return movePick(0, step);
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace relucent::gui
