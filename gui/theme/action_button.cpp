// SPDX-License-Identifier: MIT
#include "theme/action_button.h"

#include <QStyleOptionButton>
#include <QStylePainter>
#include <algorithm>

#include "theme/theme.h"

namespace relucent::gui {
namespace {

constexpr const char* whyNotName = "whyNot";
constexpr int iconSide = 18, besideIcon = 4, besideReason = 10;
constexpr int nameTop = 2, nameHeight = 18, reasonTop = 18, reasonHeight = 15;  // of a control's 36 px

QFont nameFont() {
  return typeOf(type::body, QFont::DemiBold);
}
QFont reasonFont() {
  return typeOf(type::note);
}

}  // namespace

void setPossible(QWidget* control, bool isPossible, const QString& whyNot) {
  // What it is described by otherwise stays in front.
  QString description = control->accessibleDescription();
  const QString before = whyNotPossible(*control);
  if (!before.isEmpty() && description.endsWith(before)) description.chop(before.size());
  const QString reason = isPossible ? QString() : whyNot;
  control->setProperty(whyNotName, reason);
  control->setAccessibleDescription(QString("%1 %2").arg(description.trimmed(), reason).trimmed());
  control->setEnabled(isPossible);
}

QString whyNotPossible(const QWidget& control) {
  return control.property(whyNotName).toString();
}

ActionButton::ActionButton(std::optional<Icon> icon, const QString& text, QWidget* parent)
    : EnterButton(text, parent), glyph_(icon) {
  setRole(this, "");
  setIconSize({iconSide, iconSide});
  setAutoDefault(false);
  connect(&Theme::instance(), &Theme::changed, this, &ActionButton::paintIcon);
  paintIcon();
}

void ActionButton::setWhyNot(const QString& reason) {
  if (reason == whyNotPossible(*this) && isEnabled() == reason.isEmpty()) return;
  setPossible(this, reason);
  paintIcon();
  updateGeometry();
  update();  // Qt paints again only what becomes possible or stops being so
}

void ActionButton::paintIcon() {
  if (glyph_) setIcon(iconOf(*glyph_, isEnabled() ? colours().text : colours().disabled));
}

QSize ActionButton::sizeHint() const {
  const QString reason = whyNotPossible(*this);
  QSize size = QPushButton::sizeHint();
  if (reason.isEmpty()) return size;
  const int needed = QFontMetrics(reasonFont()).horizontalAdvance(reason) + 2 * besideReason;
  return {std::max(size.width(), needed), size.height()};
}

void ActionButton::paintEvent(QPaintEvent* event) {
  const QString reason = whyNotPossible(*this);
  if (reason.isEmpty()) return QPushButton::paintEvent(event);
  QStylePainter painter(this);
  QStyleOptionButton option;
  initStyleOption(&option);
  option.text.clear();
  option.icon = {};
  painter.drawControl(QStyle::CE_PushButton, option);
  const int top = (height() - space::control) / 2;
  painter.setPen(colours().disabled);
  paintName(painter, {besideReason, top + nameTop, width() - 2 * besideReason, nameHeight});
  const QRect line(besideReason, top + reasonTop, width() - 2 * besideReason, reasonHeight);
  painter.setFont(reasonFont());
  painter.setPen(colours().secondary);
  painter.drawText(line, Qt::AlignCenter | Qt::TextDontClip | Qt::TextSingleLine,
                   painter.fontMetrics().elidedText(reason, Qt::ElideRight, line.width()));
}

void ActionButton::paintName(QPainter& painter, const QRect& line) const {
  constexpr int side = 16;
  const int beside = glyph_ ? side + besideIcon : 0;
  painter.setFont(nameFont());
  const QString name = painter.fontMetrics().elidedText(text(), Qt::ElideRight, line.width() - beside);
  const int width = beside + painter.fontMetrics().horizontalAdvance(name);
  const QRect both(line.left() + (line.width() - width) / 2, line.top(), width, line.height());
  const QRect picture(both.left(), both.top() + (both.height() - side) / 2, side, side);
  const QRect words = both.adjusted(beside, 0, 0, 0);
  if (glyph_)
    drawIcon(painter, *glyph_, QStyle::visualRect(layoutDirection(), both, picture), colours().disabled);
  painter.setPen(colours().disabled);
  painter.drawText(QStyle::visualRect(layoutDirection(), both, words),
                   Qt::AlignCenter | Qt::TextDontClip | Qt::TextSingleLine, name);
}

}  // namespace relucent::gui
