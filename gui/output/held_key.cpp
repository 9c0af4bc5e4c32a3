// SPDX-License-Identifier: MIT
#include "output/held_key.h"

#include <QKeyEvent>
#include <QWindow>
#include <utility>

namespace relucent::gui {
namespace {

/// Some X servers repeat a held key by letting it go and pressing it again at once, and Qt does not tell: so
/// long it has to be up to count as let go of.
constexpr std::chrono::milliseconds certainlyUp{40};

}  // namespace

HeldKey::HeldKey(Qt::Key key, std::chrono::milliseconds time, QObject* parent)
    : QObject(parent), key_(key), enough_(time) {
  for (QTimer* timer : {&time_, &release_}) timer->setSingleShot(true);
  connect(&time_, &QTimer::timeout, this, [this] {
    // Perhaps it is let go of just now.
    if (release_.isActive()) return time_.start(certainlyUp);
    Q_EMIT held();
  });
  connect(&release_, &QTimer::timeout, this, &HeldKey::letGo);
}

void HeldKey::watch(QWindow& window) {
  window.installEventFilter(this);
}

void HeldKey::letGo() {
  time_.stop();
  release_.stop();
  if (std::exchange(isDown_, false)) Q_EMIT released();
}

/// Others get every event, too.
bool HeldKey::eventFilter(QObject*, QEvent* event) {
  take(*event);
  return false;
}

void HeldKey::take(const QEvent& event) {
  // Whoever lets it go at another window is not heard of here.
  if (event.type() == QEvent::FocusOut || event.type() == QEvent::WindowDeactivate ||
      event.type() == QEvent::Hide)
    letGo();
  if (event.type() != QEvent::KeyPress && event.type() != QEvent::KeyRelease) return;
  const auto& key = static_cast<const QKeyEvent&>(event);
  if (key.key() != key_ || key.isAutoRepeat()) return;
  if (event.type() == QEvent::KeyRelease) return release_.start(certainlyUp);
  release_.stop();
  if (std::exchange(isDown_, true)) return;
  time_.start(enough_);
  Q_EMIT pressed();
}

}  // namespace relucent::gui
