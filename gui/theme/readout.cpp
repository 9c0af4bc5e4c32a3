// SPDX-License-Identifier: MIT
#include "theme/readout.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "theme/accessible_role.h"
#include "theme/theme.h"

namespace relucent::gui {
namespace {

QFont figures() {
  return typeOf(type::readout, QFont::DemiBold);
}

double cellOf(const QFontMetricsF& metrics) {
  double widest = 0.0;
  for (QChar digit : QString("0123456789")) widest = std::max(widest, metrics.horizontalAdvance(digit));
  return widest;
}

double advance(const QFontMetricsF& metrics, QChar letter) {
  return letter.isDigit() ? cellOf(metrics) : metrics.horizontalAdvance(letter);
}

double widthOf(const QString& value) {
  QFontMetricsF large(figures());
  double width = 0.0;
  for (QChar letter : value) width += advance(large, letter);
  return width;
}

}  // namespace

Readout::Readout(const QString& what, QWidget* parent) : QWidget(parent), what_(what) {
  setAccessibleRole(this, QAccessible::StaticText);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  connect(&Theme::instance(), &Theme::changed, this, qOverload<>(&QWidget::update));
  setValue(QString::fromUtf8("–"));
}

void Readout::setValue(const QString& value, bool warning) {
  if (value == given_ && warning == warning_) return;
  value_ = given_ = value;
  // Each sign is placed by itself, from the left: what keeps them together in a sentence is not needed.
  value_.removeIf([](QChar sign) { return sign.unicode() >= 0x2066 && sign.unicode() <= 0x2069; });
  warning_ = warning;
  setAccessibleName(QString("%1, %2").arg(what_, value));
  updateGeometry();
  update();
}

QSize Readout::sizeHint() const {
  QFontMetricsF large(figures()), small(typeOf(type::note));
  return QSizeF(std::max({widthOf(value_), small.horizontalAdvance(what_), 64.0}) + 4.0,
                large.height() + small.height())
      .toSize();
}

QSize Readout::minimumSizeHint() const {
  return {std::max(64, static_cast<int>(std::ceil(widthOf(value_))) + 4), sizeHint().height()};
}

void Readout::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  QFontMetricsF large(figures()), small(typeOf(type::note));
  painter.setFont(figures());
  painter.setPen(warning_ ? colours().amber : colours().text);
  double x = isRightToLeft() ? width() - widthOf(value_) : 0.0;
  for (QChar letter : value_) {
    double cell = advance(large, letter);
    painter.drawText(QPointF(x + (cell - large.horizontalAdvance(letter)) / 2.0, large.ascent()), letter);
    x += cell;
  }
  painter.setFont(typeOf(type::note));
  painter.setPen(colours().secondary);
  painter.drawText(QRectF(0.0, large.height(), width(), small.height()), Qt::AlignLeft,
                   small.elidedText(what_, Qt::ElideRight, width()));
}

}  // namespace relucent::gui
