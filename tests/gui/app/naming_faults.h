// SPDX-License-Identifier: MIT
#pragma once

#include <QAbstractButton>
#include <QAbstractScrollArea>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QScrollBar>
#include <QStringList>
#include <QTableWidget>
#include <QWidget>

namespace relucent::gui {

/// What a screen reader has no words for: a widget that takes the focus and has no name or is said to be
/// filler, a control that cannot be used and does not say why, a table's cell that says nothing.
class NamingFaults {
 public:
  /// Of all that is visible in a window.
  static QStringList of(const QWidget& window) {
    QStringList faults;
    for (QWidget* widget : window.findChildren<QWidget*>()) {
      if (!widget->isVisible()) continue;
      if (takesFocus(*widget)) faults << faultOf(*widget);
      if (isClosed(*widget) && widget->accessibleDescription().trimmed().isEmpty())
        faults << QString("%1 %2 \"%3\" does not say why it cannot be used")
                      .arg(widget->metaObject()->className(), widget->objectName(), widget->accessibleName());
      if (const auto* table = qobject_cast<const QTableWidget*>(widget)) faults << silentCells(*table);
    }
    faults.removeAll(QString());
    return faults;
  }

 private:
  static bool takesFocus(const QWidget& widget) {
    // What scrolls takes it for the arrow keys alone, and its contents have names.
    const bool scrollsOnly = QString(widget.metaObject()->className()) == "QScrollArea";
    return widget.isEnabled() && (widget.focusPolicy() & Qt::TabFocus) != 0 &&
           widget.focusProxy() == nullptr && !scrollsOnly;
  }

  /// By itself, not with what it stands in.
  static bool isClosed(const QWidget& widget) {
    const bool isControl = qobject_cast<const QAbstractButton*>(&widget) != nullptr ||
                           qobject_cast<const QComboBox*>(&widget) != nullptr ||
                           qobject_cast<const QAbstractSlider*>(&widget) != nullptr ||
                           qobject_cast<const QAbstractSpinBox*>(&widget) != nullptr ||
                           qobject_cast<const QLineEdit*>(&widget) != nullptr ||
                           widget.inherits("relucent::gui::Segmented");
    return isControl && widget.testAttribute(Qt::WA_ForceDisabled) &&
           qobject_cast<const QScrollBar*>(&widget) == nullptr;
  }

  static QString faultOf(QWidget& widget) {
    QAccessibleInterface* told = QAccessible::queryAccessibleInterface(&widget);
    const QString what = QString("%1 %2").arg(widget.metaObject()->className(), widget.objectName());
    if (told == nullptr) return what + " is not told of";
    // A view's text says what it shows; what a line or a box holds is no name of it.
    if (told->text(QAccessible::Name).trimmed().isEmpty()) return what + " has no name";
    if (told->role() == QAccessible::Client || told->role() == QAccessible::NoRole)
      return what + " is said to be filler";
    return {};
  }

  static QStringList silentCells(const QTableWidget& table) {
    QStringList faults;
    for (int row = 0; row < table.rowCount(); ++row)
      for (int column = 0; column < table.columnCount(); ++column) {
        const QTableWidgetItem* item = table.item(row, column);
        const bool says =
            item != nullptr && !(item->text() + item->data(Qt::AccessibleTextRole).toString()).isEmpty();
        if (!says)
          faults << QString("%1: cell %2, %3 says nothing").arg(table.objectName()).arg(row).arg(column);
      }
    return faults;
  }
};

}  // namespace relucent::gui
