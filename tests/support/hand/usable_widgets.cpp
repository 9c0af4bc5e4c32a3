// SPDX-License-Identifier: MIT
#include "support/hand/usable_widgets.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenu>
#include <QScrollArea>
#include <QScrollBar>
#include <QTextEdit>
#include <QTimer>
#include <QWindow>
#include <QtTest>

#include "support/hand/seen_widgets.h"

namespace relucent::test {
namespace {

/// Empty: nobody uses it by itself.
QString kindOf(const QWidget& widget) {
  if (qobject_cast<const QAbstractButton*>(&widget) != nullptr) return "button";
  if (qobject_cast<const QComboBox*>(&widget) != nullptr) return "choice";
  if (qobject_cast<const QScrollBar*>(&widget) != nullptr) return {};
  if (qobject_cast<const QAbstractSlider*>(&widget) != nullptr) return "slider";
  if (qobject_cast<const QAbstractSpinBox*>(&widget) != nullptr) return "field";
  if (const auto* line = qobject_cast<const QLineEdit*>(&widget))
    return qobject_cast<const QAbstractSpinBox*>(line->parent()) == nullptr ? "field" : "";
  if (qobject_cast<const QAbstractItemView*>(&widget) != nullptr) return "rows";
  if (qobject_cast<const QMenu*>(&widget) != nullptr) return "rows";
  const bool isText = qobject_cast<const QTextEdit*>(&widget) != nullptr;
  const bool scrolls = qobject_cast<const QAbstractScrollArea*>(&widget) != nullptr;
  const bool takesFocus = (widget.focusPolicy() & Qt::TabFocus) != 0;
  return takesFocus && !isText && !scrolls ? "picture" : "";
}

QString textOf(const QWidget& widget) {
  const auto* button = qobject_cast<const QAbstractButton*>(&widget);
  const QString text = button != nullptr ? button->text() : QString();
  return text.isEmpty() ? widget.accessibleName() : text;
}

bool isWithinScrolled(const QWidget& widget) {
  for (const QWidget* above = widget.parentWidget(); above != nullptr; above = above->parentWidget())
    if (qobject_cast<const QScrollArea*>(above) != nullptr) return true;
  return false;
}

void chooseFiles(QFileDialog& dialog, const QString& typed) {
  auto* name = dialog.findChild<QLineEdit*>("fileNameEdit");
  if (typed.isEmpty() || name == nullptr) return dialog.reject();
  name->setText(typed);
  QTest::keyClick(name, Qt::Key_Return);
}

QPoint placeOf(const QJsonArray& share, QSize size) {
  return {static_cast<int>(share[0].toDouble() * (size.width() - 1)),
          static_cast<int>(share[1].toDouble() * (size.height() - 1))};
}

void useNow(QWidget& widget, const QString& kind, const QJsonObject& wish) {
  QWindow* window = widget.window()->windowHandle();
  if (!widget.isEnabled() || !widget.isVisible() || window == nullptr) return;
  if (auto* files = qobject_cast<QFileDialog*>(&widget)) return chooseFiles(*files, wish["typed"].toString());
  window->requestActivate();
  const auto inWindow = [&](QPoint place) { return widget.mapTo(widget.window(), place); };
  const QPoint from = placeOf(wish["from"].toArray(), widget.size());
  const bool isTick = widget.inherits("QCheckBox");
  const QPoint middle(isTick ? widget.height() / 2 : widget.rect().center().x(), widget.rect().center().y());
  const QPoint pressed = kind == "slider" || kind == "picture" || kind == "rows" ? from : middle;
  if (!widget.visibleRegion().contains(pressed)) return;
  if (wish.contains("to")) {
    const QPoint to = placeOf(wish["to"].toArray(), widget.size());
    QTest::mousePress(window, Qt::LeftButton, {}, inWindow(pressed));
    QTest::mouseMove(window, inWindow((from + to) / 2));
    QTest::mouseMove(window, inWindow(to));
    QTest::mouseRelease(window, Qt::LeftButton, {}, inWindow(to));
    return;
  }
  // By keys a choice changes at once, by the mouse it opens its list.
  const QPointer<QWidget> still(&widget);
  const bool byKeys = kind == "choice" && !wish["keys"].toArray().isEmpty();
  if (byKeys)
    widget.setFocus(Qt::TabFocusReason);
  else
    QTest::mouseClick(window, Qt::LeftButton, {}, inWindow(pressed));
  if (wish["twice"].toBool() && still) QTest::mouseClick(window, Qt::LeftButton, {}, inWindow(pressed));
  const auto key = [&](const QKeySequence& keys) {
    if (still && still->window()->windowHandle() != nullptr)
      QTest::keySequence(still->window()->windowHandle(), keys);
  };
  if (wish.contains("typed")) {
    key(QKeySequence("Ctrl+A"));
    for (const QChar letter : wish["typed"].toString())
      if (still && still->window()->windowHandle() != nullptr)
        QTest::keyClick(still->window()->windowHandle(), letter.toLatin1());
  }
  for (const QJsonValue& each : wish["keys"].toArray()) key(QKeySequence(each.toString()));
}

}  // namespace

void scrollTo(QWidget& widget) {
  for (QWidget* above = widget.parentWidget(); above != nullptr; above = above->parentWidget())
    if (auto* area = qobject_cast<QScrollArea*>(above)) area->ensureWidgetVisible(&widget, 20, 20);
}

void UsableWidgets::add(QWidget& widget, QJsonArray& all) {
  const auto* button = qobject_cast<const QAbstractButton*>(&widget);
  const QString kind = qobject_cast<QFileDialog*>(&widget) != nullptr ? "files" : kindOf(widget);
  all.append(QJsonObject{{"id", static_cast<int>(usable_.size())},
                         {"kind", kind},
                         {"name", widget.objectName()},
                         {"text", textOf(widget)},
                         {"window", widget.window()->windowTitle()},
                         {"primary", widget.property("role").toString() == "primary"},
                         {"checked", button != nullptr && button->isChecked()}});
  usable_.push_back({&widget, kind});
}

QJsonArray UsableWidgets::survey() {
  usable_.clear();
  QJsonArray all;
  for (QWidget* window : windowsFromTheFront()) {
    const bool isAlone = window->isModal() || window == QApplication::activePopupWidget();
    const bool isFiles = qobject_cast<QFileDialog*>(window) != nullptr;
    if (isFiles || qobject_cast<QMenu*>(window) != nullptr) add(*window, all);
    if (!isFiles)
      for (QWidget* widget : window->findChildren<QWidget*>()) {
        if (widget->window() != window || !widget->isVisible() || !widget->isEnabled()) continue;
        if (kindOf(*widget).isEmpty()) continue;
        if (isInSight(*widget) || isWithinScrolled(*widget)) add(*widget, all);
      }
    if (isAlone) break;
  }
  return all;
}

QString UsableWidgets::use(const QJsonObject& wish) {
  const auto id = static_cast<std::size_t>(wish["id"].toInt());
  if (id >= usable_.size() || usable_[id].widget == nullptr) return "it has gone";
  const Usable used = usable_[id];
  scrollTo(*used.widget);
  QTimer::singleShot(0, used.widget, [used, wish] {
    if (used.widget != nullptr) useNow(*used.widget, used.kind, wish);
  });
  return {};
}

}  // namespace relucent::test
