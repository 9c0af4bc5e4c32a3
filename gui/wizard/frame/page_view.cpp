// SPDX-License-Identifier: MIT
#include "wizard/frame/page_view.h"

#include <QGuiApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QScrollArea>

#include "theme/controls.h"
#include "theme/theme.h"
#include "wizard/frame/steady_scroll.h"

namespace relucent::gui {

namespace {

constexpr const char* beginsHereName = "beginsHere";

class LeavesUndo : public QObject {
 public:
  explicit LeavesUndo(QLineEdit* field) : QObject(field), field_(field) {}

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() != QEvent::ShortcutOverride || field_->isModified())
      return QObject::eventFilter(watched, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    if (!key->matches(QKeySequence::Undo) && !key->matches(QKeySequence::Redo)) return false;
    event->ignore();
    return true;
  }

 private:
  QLineEdit* field_;
};

}  // namespace

NotYetSeen::NotYetSeen(QObject* widget) : widget_(qobject_cast<QWidget*>(widget)) {
  if (widget_ != nullptr && (widget_->parentWidget() != nullptr || widget_->isVisible())) widget_ = nullptr;
  if (widget_ != nullptr) widget_->setAttribute(Qt::WA_DontShowOnScreen);
}

NotYetSeen::~NotYetSeen() {
  if (widget_ != nullptr) widget_->setAttribute(Qt::WA_DontShowOnScreen, false);
}

bool focusFirst(QWidget* region) {
  QWidget* first = nullptr;
  for (QWidget* child : region->findChildren<QWidget*>()) {
    if (!child->isVisibleTo(region->window()) || !child->isEnabled() ||
        (child->focusPolicy() & Qt::TabFocus) == 0)
      continue;
    if (first == nullptr) first = child;
    if (!child->property(beginsHereName).toBool()) continue;
    first = child;
    break;
  }
  if (first != nullptr) first->setFocus(Qt::TabFocusReason);
  return first != nullptr;
}

void beginHere(QWidget* widget) {
  widget->setProperty(beginsHereName, true);
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

void leaveUndoToThePage(QWidget* widget, QLineEdit* field) {
  widget->installEventFilter(new LeavesUndo(field));
}

QWidget* inspectorCard(QVBoxLayout*& contents) {
  auto* card = new Card;
  auto* scroll = new SteadyScroll;
  auto* inside = new QWidget;
  contents = new QVBoxLayout(inside);
  // The scroll bar stands where lines end.
  constexpr int besideBar = 6;
  const bool isMirrored = QGuiApplication::isRightToLeft();
  contents->setContentsMargins(isMirrored ? besideBar : 0, 0, isMirrored ? 0 : besideBar, 0);
  contents->setSpacing(10);
  scroll->setWidget(inside);
  card->body()->addWidget(scroll);
  return card;
}

}  // namespace relucent::gui
