// SPDX-License-Identifier: MIT
#pragma once

#include <QAbstractScrollArea>
#include <QAccessible>
#include <QLabel>
#include <QStringList>
#include <QTableWidget>
#include <QWidget>

namespace relucent::gui {

/// What a screen reader has no words for: a widget that takes the focus and has no name or is said to be
/// filler, a table's cell that says nothing.
class NamingFaults {
 public:
  /// Of all that is visible in a window.
  static QStringList of(const QWidget& window) {
    QStringList faults;
    for (QWidget* widget : window.findChildren<QWidget*>()) {
      if (!widget->isVisible()) continue;
      if (takesFocus(*widget)) faults << faultOf(*widget);
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
