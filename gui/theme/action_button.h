// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "theme/enter_button.h"
#include "theme/icons.h"

namespace relucent::gui {

/// Enables a control, or says to a screen reader why it is not; whoever sees reads it beside. `whyNot`: a
/// short sentence.
void setPossible(QWidget* control, bool isPossible, const QString& whyNot);
/// The same; empty: it can be used.
inline void setPossible(QWidget* control, const QString& whyNot) {
  setPossible(control, whyNot.isEmpty(), whyNot);
}
/// What was said last; empty: it can be used.
QString whyNotPossible(const QWidget& control);

/// A button that says why it cannot be pressed: the reason is a second, smaller line within it, so that
/// nothing round it moves. With an icon of the theme or without.
class ActionButton : public EnterButton {
  Q_OBJECT

 public:
  explicit ActionButton(const QString& text, QWidget* parent = nullptr)
      : ActionButton(std::nullopt, text, parent) {}
  ActionButton(std::optional<Icon> icon, const QString& text, QWidget* parent = nullptr);
  /// As setPossible().
  void setWhyNot(const QString& reason);
  /// With the reason in one line, where there is one.
  QSize sizeHint() const override;
  /// A reason that has no room ends in an ellipsis.
  QSize minimumSizeHint() const override { return QPushButton::sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintIcon();
  void paintName(QPainter& painter, const QRect& line) const;
  std::optional<Icon> glyph_;
};

}  // namespace relucent::gui
