// SPDX-License-Identifier: MIT
#include "theme/enter_button.h"

#include <QKeyEvent>

namespace relucent::gui {

void EnterButton::keyPressEvent(QKeyEvent* event) {
  const bool isEnter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
  const bool isAlone = (event->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
  if (!isEnter || !isAlone || isCheckable()) return QPushButton::keyPressEvent(event);
  event->accept();
  if (!event->isAutoRepeat()) click();
}

}  // namespace relucent::gui
