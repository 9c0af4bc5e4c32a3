// SPDX-License-Identifier: MIT
#pragma once

#include <QAccessible>
#include <QWidget>

namespace relucent::gui {

/// What a widget of our own is for those who do not see it: a picture, a chart, a slider. Without it, it is
/// said to be filler.
void setAccessibleRole(QWidget* widget, QAccessible::Role role);

}  // namespace relucent::gui
