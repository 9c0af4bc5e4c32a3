// SPDX-License-Identifier: MIT
#include "theme/quiet_wheel.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QEvent>
#include <QSlider>

namespace relucent::gui {
namespace {

bool isTurned(const QObject* object) {
  return qobject_cast<const QSlider*>(object) != nullptr ||
         qobject_cast<const QComboBox*>(object) != nullptr ||
         qobject_cast<const QAbstractSpinBox*>(object) != nullptr;
}

}  // namespace

QuietWheel::QuietWheel(QObject* parent) : QObject(parent) {
  qApp->installEventFilter(this);
}

bool QuietWheel::eventFilter(QObject* watched, QEvent* event) {
  if ((event->type() != QEvent::Wheel && event->type() != QEvent::Polish) || !isTurned(watched)) return false;
  auto* control = static_cast<QWidget*>(watched);
  if (event->type() == QEvent::Polish) {
    if (control->focusPolicy() == Qt::WheelFocus) control->setFocusPolicy(Qt::StrongFocus);
    return false;
  }
  const bool isList = qobject_cast<QComboBox*>(control) != nullptr;
  if (control->hasFocus() && !isList) return false;
  event->ignore();  // it goes on to what is behind
  return true;
}

}  // namespace relucent::gui
