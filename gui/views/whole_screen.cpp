// SPDX-License-Identifier: MIT
#include "views/whole_screen.h"

#include <QCloseEvent>
#include <QKeyEvent>
#include <QLayout>
#include <QScreen>
#include <QVBoxLayout>
#include <memory>

namespace relucent::gui {

WholeScreen::WholeScreen(QWidget& view)
    : QWidget(view.window(), Qt::Window | Qt::FramelessWindowHint), view_(&view), place_(new QWidget) {
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowTitle(view.accessibleName());
  QWidget* page = view.parentWidget();
  std::unique_ptr<QLayoutItem> before(page->layout()->replaceWidget(&view, place_));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(&view);
  view.show();
  // Said twice: without a window manager nobody hears the second.
  setGeometry(page->screen()->geometry());
  showFullScreen();
  view.setFocus(Qt::OtherFocusReason);
}

WholeScreen::~WholeScreen() {
  giveBack();
}

void WholeScreen::giveBack() {
  if (!view_ || !place_) return;
  QWidget *view = view_, *page = place_->parentWidget();
  if (page == nullptr || page->layout() == nullptr) return;  // the page itself is going
  view_ = nullptr;
  std::unique_ptr<QLayoutItem> before(page->layout()->replaceWidget(place_, view));
  delete place_.data();
  view->show();
  view->setFocus(Qt::OtherFocusReason);
}

void WholeScreen::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape || event->key() == Qt::Key_F11) {
    close();
    return;
  }
  QWidget::keyPressEvent(event);
}

void WholeScreen::closeEvent(QCloseEvent* event) {
  giveBack();
  event->accept();
}

}  // namespace relucent::gui
