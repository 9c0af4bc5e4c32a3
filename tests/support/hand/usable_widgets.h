// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonArray>
#include <QJsonObject>
#include <QPointer>
#include <QWidget>
#include <vector>

namespace relucent::test {

/// Brings it into sight, as somebody turns the wheel.
void scrollTo(QWidget& widget);

/// What somebody may do with the windows now: each button, choice, slider, field, list, picture that is
/// enabled and not behind a window that blocks it.
class UsableWidgets {
 public:
  /// Looks again. Each: {"id", "kind", "name", "text", "window", "primary", "checked"}, where the kind is
  /// "button", "choice", "slider", "field", "rows", "picture", or "files" for a dialog that chooses some.
  QJsonArray survey();
  /// Does it as soon as the loop is free, since it may begin a loop of its own: {"id", "from": [x, y], "to":
  /// [x, y] as shares of it, "typed", "keys": [...], "twice"}. Empty, or why it cannot be done.
  QString use(const QJsonObject& wish);

 private:
  struct Usable {
    QPointer<QWidget> widget;
    QString kind;
  };
  void add(QWidget& widget, QJsonArray& all);

  std::vector<Usable> usable_;
};

}  // namespace relucent::test
