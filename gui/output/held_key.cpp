// SPDX-License-Identifier: MIT
#include "output/held_key.h"

#include <QKeyEvent>
#include <QWindow>

namespace relucent::gui {

HeldKey::HeldKey(Qt::Key key, std::chrono::milliseconds time, QObject* parent) : QObject(parent), key_(key) {
  time_.setSingleShot(true);
  time_.setInterval(time);
  connect(&time_, &QTimer::timeout, this, &HeldKey::held);
}

void HeldKey::watch(QWindow& window) {
  window.installEventFilter(this);
}

/// Others get every event, too.
bool HeldKey::eventFilter(QObject*, QEvent* event) {
  // Whoever lets it go at another window is not heard of here.
  if (event->type() == QEvent::FocusOut || event->type() == QEvent::Hide) time_.stop();
  if (event->type() != QEvent::KeyPress && event->type() != QEvent::KeyRelease) return false;
  const auto* key = static_cast<const QKeyEvent*>(event);
  // A held key is repeated: let go and pressed again, as far as events tell.
  if (key->key() != key_ || key->isAutoRepeat()) return false;
  event->type() == QEvent::KeyPress ? time_.start() : time_.stop();
  return false;
}

}  // namespace relucent::gui
