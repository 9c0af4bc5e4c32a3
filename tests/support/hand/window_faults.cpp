// SPDX-License-Identifier: MIT
#include "support/hand/window_faults.h"

#include <QAbstractButton>
#include <QApplication>
#include <QLabel>
#include <QProgressBar>
#include <QRegularExpression>

#include "gui/app/layout_faults.h"
#include "gui/app/naming_faults.h"
#include "support/hand/seen_widgets.h"

namespace relucent::test {
namespace {

QString textOf(const QWidget& widget) {
  if (const auto* label = qobject_cast<const QLabel*>(&widget)) return label->text();
  if (const auto* button = qobject_cast<const QAbstractButton*>(&widget)) return button->text();
  return {};
}

/// A place for a value that has none, the key of a message, a number that is none.
void lookForUnfinishedWords(const QWidget& window, QStringList& faults) {
  static const QRegularExpression unfilled(R"(%L?\d|%n|\{\d*\})"), key(R"(^[a-z]+([.-][a-z]+)*\.[a-z-]+$)"),
      noNumber(R"((^|[\s(-])(nan|inf)($|[\s%,.)]))");
  for (const QWidget* widget : window.findChildren<QWidget*>()) {
    if (widget->window() != &window || !isInSight(*widget)) continue;
    for (const QString& text :
         {textOf(*widget), widget->toolTip(), widget->accessibleName(), widget->accessibleDescription()})
      if (unfilled.match(text).hasMatch() || key.match(text).hasMatch() || noNumber.match(text).hasMatch())
        faults << QString("\"%1\" is no text for people (%2)").arg(text, widget->objectName());
  }
}

void lookAtPrimary(const QWidget& window, QStringList& faults) {
  QStringList primaries;
  for (const auto* button : window.findChildren<QAbstractButton*>()) {
    if (button->window() != &window || !button->isVisible()) continue;
    if (button->property("role").toString() != "primary") continue;
    primaries << button->text();
    const QString which = QString("the primary button \"%1\"").arg(button->text());
    if (button->text().isEmpty()) faults << "a primary button says nothing";
    if (!button->visibleRegion().boundingRect().contains(button->rect()))
      faults << which + QString(" is not all in sight at %1x%2").arg(window.width()).arg(window.height());
    if (button->objectName() != "primary") continue;
    const auto* hint = window.findChild<QLabel*>("hint");
    if (!button->isEnabled() && (hint == nullptr || hint->text().isEmpty() || !isInSight(*hint)))
      faults << which + " cannot be pressed, and nothing says why";
  }
  if (primaries.size() > 1) faults << "several primary buttons: " + primaries.join(", ");
}

}  // namespace

QStringList windowFaults() {
  QStringList faults;
  for (const QWidget* window : windowsFromTheFront()) {
    if (window->inherits("QFileDialog") || window == QApplication::activePopupWidget()) break;
    QStringList layout = gui::LayoutFaults::of(*window);
    // In a small window the words under a figure may be cut off, and a choice has room for what is chosen
    // alone.
    constexpr int usualWidth = 1366;
    layout.removeIf([window](const QString& fault) {
      return window->width() < usualWidth &&
             (fault.startsWith("relucent::gui::Readout") || fault.startsWith("QComboBox"));
    });
    faults << layout << gui::NamingFaults::of(*window);
    lookForUnfinishedWords(*window, faults);
    lookAtPrimary(*window, faults);
    if (window->isModal()) break;
  }
  return faults;
}

QJsonObject progressInSight() {
  for (const QWidget* window : windowsFromTheFront())
    for (const auto* bar : window->findChildren<QProgressBar*>())
      if (bar->isVisible() && bar->parentWidget()->inherits("relucent::gui::ActionBar"))
        return {{"shown", bar->styleSheet().isEmpty()}, {"permille", bar->value()}};
  return {};
}

}  // namespace relucent::test
