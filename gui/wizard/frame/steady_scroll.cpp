// SPDX-License-Identifier: MIT
#include "wizard/frame/steady_scroll.h"

#include <QApplication>
#include <QCursor>
#include <QEvent>
#include <QLayout>
#include <QScrollBar>
#include <algorithm>
#include <ranges>

namespace relucent::gui {

SteadyScroll::SteadyScroll(QWidget* parent) : QScrollArea(parent) {
  setWidgetResizable(true);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setFocusPolicy(Qt::NoFocus);
  setFrameShape(QFrame::NoFrame);
}

void SteadyScroll::showEvent(QShowEvent* event) {
  if (!event->spontaneous()) {
    verticalScrollBar()->setValue(0);
    pointer_ = QCursor::pos();
    focus_ = QApplication::focusWidget();
  }
  QScrollArea::showEvent(event);
  look();
}

void SteadyScroll::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  look();
}

void SteadyScroll::scrollContentsBy(int x, int y) {
  QScrollArea::scrollContentsBy(x, y);
  look();
}

bool SteadyScroll::eventFilter(QObject* watched, QEvent* event) {
  // What is shown lays the column out at once, which makes it higher; what goes does so later.
  const bool isLaidOut = event->type() == QEvent::LayoutRequest || event->type() == QEvent::Resize;
  if (watched != widget() || !isLaidOut || !isVisible() || isHolding_)
    return QScrollArea::eventFilter(watched, event);
  isHolding_ = true;
  const Seen* held = anchor();
  const QPointer<QWidget> widget = held != nullptr ? held->widget : nullptr;
  const int before = held != nullptr ? held->where.top() : 0;
  const bool isTaken = QScrollArea::eventFilter(watched, event);
  if (this->widget()->layout() != nullptr) this->widget()->layout()->activate();
  if (widget != nullptr && widget->isVisible()) {
    QScrollBar* bar = verticalScrollBar();
    bar->setValue(bar->value() + placeOf(*widget).top() - before);
  }
  isHolding_ = false;
  look();
  return isTaken;
}

QRect SteadyScroll::placeOf(const QWidget& widget) const {
  return {widget.mapTo(viewport(), QPoint(0, 0)), widget.size()};
}

/// Not while the column is laid out: what moves meanwhile is held against where it stood before.
/// Parts alone stand still when something in them does not: what counts is what has no parts.
void SteadyScroll::look() {
  if (widget() == nullptr || isHolding_) return;
  seen_.clear();
  const QRect room = viewport()->rect();
  for (QWidget* child : widget()->findChildren<QWidget*>())
    if (child->layout() == nullptr && child->isVisible())
      if (const QRect where = placeOf(*child); where.intersects(room)) seen_.push_back({child, where});
  std::ranges::stable_sort(seen_, {}, [](const Seen& one) { return one.where.top(); });
}

const SteadyScroll::Seen* SteadyScroll::anchor() const {
  const auto isThere = [](const Seen& one) { return one.widget != nullptr && one.widget->isVisible(); };
  const QPoint pointer = viewport()->mapFromGlobal(QCursor::pos());
  if (QCursor::pos() != pointer_ && viewport()->rect().contains(pointer))
    // Where that has gone, what came after it.
    for (const Seen& one : seen_)
      if (one.where.bottom() >= pointer.y() && isThere(one)) return &one;
  const QWidget* focus = QApplication::focusWidget();
  for (const Seen& one : seen_)
    if (focus != nullptr && focus != focus_ && one.widget == focus && isThere(one)) return &one;
  if (verticalScrollBar()->value() == 0) return nullptr;
  const auto first =
      std::ranges::find_if(seen_, [&](const Seen& one) { return one.where.top() >= 0 && isThere(one); });
  return first != seen_.end() ? &*first : nullptr;
}

}  // namespace relucent::gui
