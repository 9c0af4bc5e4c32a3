// SPDX-License-Identifier: MIT
#pragma once

#include <QProxyStyle>

namespace relucent::gui {

/// What the style sheet draws upon: Fusion.
class BaseStyle : public QProxyStyle {
  Q_OBJECT

 public:
  BaseStyle() : QProxyStyle("Fusion") {}

  /// Beside its icon a button's text is aligned twice by Qt's style sheets where it is read from the right:
  /// once by them, once by the painter. It would stand at the far end of the button.
  void drawItemText(QPainter* painter, const QRect& rectangle, int flags, const QPalette& palette,
                    bool enabled, const QString& text, QPalette::ColorRole role) const override;
  /// What is disabled is fainter. Etched, it would be drawn twice, and brighter than what can be chosen.
  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                QStyleHintReturn* more) const override;
};

}  // namespace relucent::gui
