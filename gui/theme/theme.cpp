// SPDX-License-Identifier: MIT
#include "theme/theme.h"

#include <QApplication>
#include <QFontDatabase>
#include <QPalette>
#include <QStyle>

#include "theme/base_style.h"

namespace relucent::gui {
namespace {

QStringList families() {
  QStringList wanted{"Inter", "Noto Sans", "DejaVu Sans"};
  QStringList present = QFontDatabase::families();
  QStringList found;
  for (const QString& family : wanted)
    if (present.contains(family)) found.append(family);
  return found.isEmpty() ? QStringList{QApplication::font().family()} : found;
}

QPalette paletteOf(const Colours& colours) {
  QPalette palette;
  palette.setColor(QPalette::Window, colours.window);
  palette.setColor(QPalette::WindowText, colours.text);
  palette.setColor(QPalette::Base, colours.input);
  palette.setColor(QPalette::AlternateBase, colours.card);
  palette.setColor(QPalette::Text, colours.text);
  palette.setColor(QPalette::Button, colours.raised);
  palette.setColor(QPalette::ButtonText, colours.text);
  palette.setColor(QPalette::Highlight, colours.accent);
  palette.setColor(QPalette::HighlightedText, colours.onAccent);
  palette.setColor(QPalette::ToolTipBase, colours.raised);
  palette.setColor(QPalette::ToolTipText, colours.text);
  palette.setColor(QPalette::PlaceholderText, colours.disabled);
  palette.setColor(QPalette::Link, colours.accent);
  for (QPalette::ColorRole role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, colours.disabled);
  return palette;
}

}  // namespace

Theme& Theme::instance() {
  static Theme theme;
  return theme;
}

void Theme::apply(Look look) {
  look_ = look;
  // Under a style sheet, style, palette and font would each have all widgets styled again.
  qApp->setStyleSheet({});
  QApplication::setStyle(new BaseStyle);
  QApplication::setPalette(paletteOf(colours()));
  QApplication::setFont(typeOf(type::body));
  qApp->setStyleSheet(styleSheetOf(colours()));
  Q_EMIT changed();
}

void Theme::setDimmed(bool dimmed) {
  if (dimmed == dimmed_) return;
  dimmed_ = dimmed;
  Q_EMIT changed();
}

QFont typeOf(int pixels, int weight) {
  static const QStringList names = families();
  QFont font;
  font.setFamilies(names);
  font.setPixelSize(pixels);
  font.setWeight(static_cast<QFont::Weight>(weight));
  return font;
}

void setRole(QWidget* widget, const char* role) {
  widget->setProperty("role", role);
  widget->style()->unpolish(widget);
  widget->style()->polish(widget);
}

}  // namespace relucent::gui
