// SPDX-License-Identifier: MIT
#pragma once

#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QScrollArea>
#include <QStringList>
#include <QStyle>
#include <QTableWidget>
#include <QToolButton>

namespace relucent::gui {

/// Where a layout gives a widget less room than its text needs. Our own widgets are known by their names, so
/// that it also looks into a program that it is not linked with.
class LayoutFaults {
 public:
  /// Of all that is visible in a window which has been laid out: the widget, what is wrong, its text.
  static QStringList of(const QWidget& window) {
    LayoutFaults found(window);
    for (const QWidget* widget : window.findChildren<QWidget*>())
      if (widget->isVisible()) found.look(*widget);
    return found.faults_;
  }

 private:
  explicit LayoutFaults(const QWidget& window) : window_(window) {}

  void tell(const QWidget& widget, const QString& text, const QString& what) {
    QString name = widget.objectName();
    for (const QWidget* above = &widget; name.isEmpty() && above != &window_; above = above->parentWidget())
      name = above->parentWidget()->objectName();
    faults_ << QString("%1 %2: \"%3\" %4").arg(widget.metaObject()->className(), name, text, what);
  }
  void need(const QWidget& widget, const QString& text, int width, int height) {
    if (width > widget.width())
      tell(widget, text, QString("needs a width of %1, has %2").arg(width).arg(widget.width()));
    if (height > widget.height())
      tell(widget, text, QString("needs a height of %1, has %2").arg(height).arg(widget.height()));
  }
  void need(const QWidget& widget, const QString& text, QSize size) {
    need(widget, text, size.width(), size.height());
  }

  void look(const QWidget& widget) {
    QString text;
    if (const auto* label = qobject_cast<const QLabel*>(&widget)) {
      text = label->text();
      // What is elided is read whole where the pointer rests.
      if (!text.isEmpty() && !label->inherits("relucent::gui::ElidedLabel")) lookAt(*label);
    } else if (const auto* button = qobject_cast<const QAbstractButton*>(&widget)) {
      text = button->text();
      if (!text.isEmpty()) lookAt(*button);
    } else if (const auto* box = qobject_cast<const QComboBox*>(&widget)) {
      text = box->currentText();
      if (box->count() > 0) need(*box, text, box->sizeHint());
    } else if (const auto* line = qobject_cast<const QLineEdit*>(&widget)) {
      constexpr int frames = 24;
      if (line->text().isEmpty()) text = line->placeholderText();
      if (!text.isEmpty()) need(*line, text, line->fontMetrics().horizontalAdvance(text) + frames, 0);
    } else if (const auto* table = qobject_cast<const QTableWidget*>(&widget)) {
      lookAt(*table);
    } else if (const auto* list = qobject_cast<const QListWidget*>(&widget)) {
      lookAt(*list);
    } else if (widget.inherits("relucent::gui::Readout")) {
      text = widget.accessibleName();
      need(widget, text, widget.sizeHint());
    } else if (widget.inherits("relucent::gui::LineChart") ||
               widget.inherits("relucent::gui::CutHistogram")) {
      text = widget.accessibleName();
      need(widget, text, widget.minimumSizeHint());
    }
    if (!text.isEmpty()) lookRound(widget, text);
  }

  void lookAt(const QLabel& label) {
    if (!label.wordWrap()) return need(label, label.text(), label.sizeHint());
    need(label, label.text(), 0, label.heightForWidth(label.width()));
    QRect room(0, 0, label.contentsRect().width(), 1 << 20);
    int widest = label.fontMetrics().boundingRect(room, Qt::TextWordWrap, label.text()).width();
    need(label, label.text(), widest + label.width() - room.width(), 0);
  }
  void lookAt(const QAbstractButton& button) {
    bool wraps = button.hasHeightForWidth();
    bool elides = button.inherits("relucent::gui::StepButton");
    need(button, button.text(), wraps || elides ? button.minimumSizeHint() : button.sizeHint());
    if (wraps) need(button, button.text(), 0, button.heightForWidth(button.width()));
  }
  void lookAt(const QListWidget& list) {
    if (list.textElideMode() != Qt::ElideRight || list.count() == 0) return;
    if (!list.wordWrap())
      return need(*list.viewport(), list.item(0)->text(),
                  static_cast<const QAbstractItemView&>(list).sizeHintForColumn(0), 0);
    for (int row = 0; row < list.count(); ++row) {
      const QString text = list.item(row)->text();
      const QRect has = list.visualItemRect(list.item(row));
      const QRect room(0, 0, has.width() - list.style()->pixelMetric(QStyle::PM_ListViewIconSize), 1 << 20);
      const QRect needed = list.fontMetrics().boundingRect(room, Qt::TextWordWrap, text);
      if (needed.width() > room.width() || needed.height() > has.height())
        tell(list, text,
             QString("needs %1x%2, has %3x%4")
                 .arg(needed.width())
                 .arg(needed.height())
                 .arg(room.width())
                 .arg(has.height()));
    }
  }
  void lookAt(const QTableWidget& table) {
    for (int column = 0; column < table.columnCount(); ++column) {
      const QHeaderView& header = *table.horizontalHeader();
      if (header.isSectionHidden(column)) continue;  // left out for want of room, not cut
      QString title = table.horizontalHeaderItem(column)->text();
      int cells = static_cast<const QAbstractItemView&>(table).sizeHintForColumn(column);
      int needed = std::max(header.sectionSizeHint(column), cells);
      int has = table.columnWidth(column), end = header.sectionPosition(column) + needed;
      if (needed > has || end > table.viewport()->width())
        tell(table, title,
             QString("needs a column of %1, has %2, and ends at %3 of %4")
                 .arg(needed)
                 .arg(has)
                 .arg(end)
                 .arg(table.viewport()->width()));
    }
  }

  /// Nothing round it may cut it off; what scrolls may hide it below.
  void lookRound(const QWidget& widget, const QString& text) {
    QRect place(widget.rect());
    bool scrolls = false;
    for (const QWidget* inside = &widget; inside != &window_ && !inside->isWindow();
         inside = inside->parentWidget()) {
      const QWidget* outside = inside->parentWidget();
      place.translate(inside->pos());
      scrolls = scrolls || qobject_cast<const QScrollArea*>(outside->parentWidget()) != nullptr;
      bool across = place.left() < 0 || place.right() >= outside->width();
      bool down = !scrolls && (place.top() < 0 || place.bottom() >= outside->height());
      if (!across && !down) continue;
      return tell(
          widget, text,
          QString("is cut off by %1 %2").arg(outside->metaObject()->className(), outside->objectName()));
    }
  }

  const QWidget& window_;
  QStringList faults_;
};

}  // namespace relucent::gui
