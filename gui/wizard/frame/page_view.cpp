// SPDX-License-Identifier: MIT
#include "wizard/frame/page_view.h"

#include <QScrollArea>

#include "theme/controls.h"
#include "theme/theme.h"

namespace relucent::gui {

bool focusFirst(QWidget* region) {
  for (QWidget* child : region->findChildren<QWidget*>()) {
    if (!child->isVisibleTo(region->window()) || !child->isEnabled() ||
        (child->focusPolicy() & Qt::TabFocus) == 0)
      continue;
    child->setFocus(Qt::TabFocusReason);
    return true;
  }
  return false;
}

void bringIntoSight(QWidget* widget) {
  for (QWidget* around = widget->parentWidget(); around != nullptr; around = around->parentWidget())
    if (auto* scroll = qobject_cast<QScrollArea*>(around)) scroll->ensureWidgetVisible(widget);
}

void pointOut(QWidget* widget) {
  if (!widget->isVisible()) return;
  if (widget->focusPolicy() == Qt::NoFocus)
    focusFirst(widget);
  else
    widget->setFocus(Qt::TabFocusReason);
  bringIntoSight(widget);
}

QWidget* inspectorCard(QVBoxLayout*& contents) {
  auto* card = new Card;
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setFrameShape(QFrame::NoFrame);
  auto* inside = new QWidget;
  contents = new QVBoxLayout(inside);
  contents->setContentsMargins(0, 0, 2, 0);
  contents->setSpacing(10);
  scroll->setWidget(inside);
  card->body()->addWidget(scroll);
  return card;
}

}  // namespace relucent::gui
