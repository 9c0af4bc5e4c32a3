// SPDX-License-Identifier: MIT
#include "theme/accessible_role.h"

#include <QAccessibleWidget>
#include <QVariant>

namespace relucent::gui {
namespace {

constexpr const char* property = "accessibleRole";

QAccessibleInterface* withRole(const QString&, QObject* object) {
  auto* widget = qobject_cast<QWidget*>(object);
  if (widget == nullptr || !widget->property(property).isValid()) return nullptr;
  return new QAccessibleWidget(widget, static_cast<QAccessible::Role>(widget->property(property).toInt()));
}

}  // namespace

void setAccessibleRole(QWidget* widget, QAccessible::Role role) {
  [[maybe_unused]] static const bool isInstalled = [] {
    QAccessible::installFactory(withRole);
    return true;
  }();
  widget->setProperty(property, static_cast<int>(role));
  // Somebody may have asked before.
  if (QAccessibleInterface* told = QAccessible::queryAccessibleInterface(widget))
    QAccessible::deleteAccessibleInterface(QAccessible::uniqueId(told));
}

}  // namespace relucent::gui
