// SPDX-License-Identifier: MIT
#include "support/hand/seen_widgets.h"

#include <QAbstractButton>
#include <QApplication>
#include <QHash>
#include <QImage>
#include <QJsonArray>
#include <QLabel>
#include <QLineEdit>
#include <QPixmap>
#include <QPushButton>
#include <algorithm>
#include <cmath>

namespace relucent::test {
namespace {

/// A text that had no room stands in full in the tooltip.
QString wholeText(const QLabel& label) {
  const bool isCut = label.text().contains(QChar(0x2026)) && !label.toolTip().isEmpty();
  return isCut ? label.toolTip() : label.text();
}

QJsonObject seen(const QWidget& widget) {
  QJsonObject found{{"name", widget.objectName()}, {"role", widget.property("role").toString()}};
  if (const auto* label = qobject_cast<const QLabel*>(&widget)) {
    if (label->text().isEmpty()) return {};
    found["text"] = wholeText(*label);
    return found;
  }
  if (const auto* field = qobject_cast<const QLineEdit*>(&widget)) {
    found["text"] = field->text();
    found["kind"] = "field";
    return found;
  }
  const auto* button = qobject_cast<const QAbstractButton*>(&widget);
  if (button == nullptr) return {};
  const auto* pushButton = qobject_cast<const QPushButton*>(button);
  found["kind"] = "button";
  found["text"] = button->text();
  found["enabled"] = button->isEnabled();
  found["checked"] = button->isChecked();
  found["default"] = pushButton != nullptr && pushButton->isDefault();
  found["spoken"] = button->accessibleName();
  found["more"] = button->accessibleDescription();
  return found;
}

QImage pictureOf(QWidget& widget) {
  return widget.grab().toImage().convertToFormat(QImage::Format_RGB32);
}

}  // namespace

bool isInSight(const QWidget& widget) {
  return widget.isVisible() && !widget.visibleRegion().isEmpty();
}

QWidgetList windowsFromTheFront() {
  QWidgetList windows;
  for (QWidget* window : QApplication::topLevelWidgets())
    if (window->isVisible() && window->windowType() != Qt::ToolTip) windows << window;
  // What blocks others stands before them.
  std::stable_sort(windows.begin(), windows.end(), [](const QWidget* a, const QWidget* b) {
    const auto depth = [](const QWidget* window) {
      int parents = window->isModal() ? 100 : 0;
      while ((window = window->parentWidget()) != nullptr) ++parents;
      return parents;
    };
    return depth(a) > depth(b);
  });
  if (QWidget* popup = QApplication::activePopupWidget()) {
    windows.removeAll(popup);
    windows.prepend(popup);
  }
  return windows;
}

QJsonObject allInSight() {
  QJsonArray windows;
  for (const QWidget* window : windowsFromTheFront()) {
    QJsonArray parts;
    for (const QWidget* widget : window->findChildren<QWidget*>()) {
      if (widget->window() != window || !isInSight(*widget)) continue;
      if (const QJsonObject part = seen(*widget); !part.isEmpty()) parts.append(part);
    }
    windows.append(QJsonObject{{"title", window->windowTitle()},
                               {"name", window->objectName()},
                               {"blocks", window->isModal()},
                               {"parts", parts}});
  }
  return {{"windows", windows}};
}

int pixelsOf(QWidget& widget, const QColor& colour) {
  constexpr int near = 6;  // of 255
  const QImage picture = pictureOf(widget);
  int count = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const QColor pixel(picture.pixel(x, y));
      count += std::abs(pixel.red() - colour.red()) < near &&
               std::abs(pixel.green() - colour.green()) < near &&
               std::abs(pixel.blue() - colour.blue()) < near;
    }
  return count;
}

double commonestShare(QWidget& widget) {
  const QImage picture = pictureOf(widget);
  QHash<QRgb, int> counts;
  int most = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) most = std::max(most, ++counts[picture.pixel(x, y)]);
  return static_cast<double>(most) / std::max(1, picture.width() * picture.height());
}

}  // namespace relucent::test
