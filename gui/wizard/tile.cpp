// SPDX-License-Identifier: MIT
#include "wizard/tile.h"

#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>

#include "theme/theme.h"

namespace relucent {

Tile::Tile(Icon icon, const QString& name, const QString& sentence, QWidget* parent)
    : QAbstractButton(parent), icon_(icon) {
  init(name, sentence);
}

Tile::Tile(const QImage& picture, const QString& name, const QString& sentence, QWidget* parent)
    : QAbstractButton(parent), picture_(picture) {
  init(name, sentence);
}

void Tile::init(const QString& name, const QString& sentence) {
  setText(name);
  sentence_ = sentence;
  setAccessibleName(name);
  setAccessibleDescription(sentence);
  setFocusPolicy(Qt::StrongFocus);
  setSizePolicy(QSizePolicy::Expanding, picture_.isNull() ? QSizePolicy::Preferred : QSizePolicy::Expanding);
  connect(&Theme::instance(), &Theme::changed, this, qOverload<>(&QWidget::update));
}

void Tile::setDashed(bool dashed) {
  dashed_ = dashed;
  update();
}

void Tile::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)
    click();
  else
    QAbstractButton::keyPressEvent(event);
}

void Tile::enterEvent(QEnterEvent*) {
  update();
}

void Tile::leaveEvent(QEvent*) {
  update();
}

void Tile::paintPicture(QPainter& painter, QRectF area) const {
  QPainterPath shape;
  shape.addRoundedRect(area, 4.0, 4.0);
  painter.save();
  painter.setClipPath(shape);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  QSizeF size = QSizeF(picture_.size()).scaled(area.size(), Qt::KeepAspectRatioByExpanding);
  painter.setOpacity(Theme::instance().pictureBrightness());
  painter.drawImage(QRectF(area.center() - QPointF(size.width() / 2.0, size.height() / 2.0), size), picture_);
  painter.restore();
}

void Tile::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  bool chosen = isChecked(), warm = chosen || (isEnabled() && (underMouse() || isDown()));
  const Colours& c = colours();
  QRectF box = QRectF(rect()).adjusted(1, 1, -1, -1);
  painter.setPen(QPen(hasFocus() ? c.text
                      : chosen   ? c.accent
                      : warm     ? c.border
                      : dashed_  ? c.amber
                                 : c.line,
                      hasFocus() ? 2.0 : 1.0, dashed_ ? Qt::DashLine : Qt::SolidLine));
  painter.setBrush(chosen ? c.accentGround : c.card);
  painter.drawRoundedRect(box, space::cardRadius, space::cardRadius);

  QFont bold = typeOf(type::section, QFont::DemiBold), small = typeOf(type::note);
  int lines = 2 * QFontMetrics(small).height() + 4;
  double textTop = height() - 16.0 - lines - QFontMetrics(bold).height();
  if (icon_) {
    drawIcon(painter, *icon_, QRectF(20, 22, 28, 28), chosen ? c.accent : c.secondary);
    textTop = std::max(64.0, (height() - lines) / 2.0 - 2.0);
  } else {
    paintPicture(painter, QRectF(9, 9, width() - 18.0, std::max(20.0, textTop - 18.0)));
  }
  double left = icon_ ? 20.0 : 14.0;
  QRectF text(left, textTop, width() - 2.0 * left, QFontMetrics(bold).height() + 2.0);
  painter.setPen(isEnabled() ? c.text : c.disabled);
  painter.setFont(bold);
  painter.drawText(
      text, Qt::AlignLeft | Qt::AlignVCenter,
      QFontMetrics(bold).elidedText(Tile::text(), Qt::ElideRight, static_cast<int>(text.width())));
  painter.setPen(isEnabled() ? c.secondary : c.disabled);
  painter.setFont(small);
  painter.drawText(QRectF(left, text.bottom() + 4.0, text.width(), lines), Qt::AlignLeft | Qt::TextWordWrap,
                   sentence_);
}

}  // namespace relucent
