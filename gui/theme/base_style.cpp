// SPDX-License-Identifier: MIT
#include "theme/base_style.h"

#include <QPainter>

namespace relucent::gui {

void BaseStyle::drawItemText(QPainter* painter, const QRect& rectangle, int flags, const QPalette& palette,
                             bool enabled, const QString& text, QPalette::ColorRole role) const {
  const bool isAlignedTwice = painter->layoutDirection() == Qt::RightToLeft &&
                              (flags & Qt::TextShowMnemonic) != 0 && (flags & Qt::AlignRight) != 0 &&
                              (flags & Qt::AlignAbsolute) == 0;
  if (isAlignedTwice) flags |= Qt::AlignAbsolute;
  QProxyStyle::drawItemText(painter, rectangle, flags, palette, enabled, text, role);
}

int BaseStyle::styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                         QStyleHintReturn* more) const {
  return hint == SH_EtchDisabledText ? 0 : QProxyStyle::styleHint(hint, option, widget, more);
}

}  // namespace relucent::gui
