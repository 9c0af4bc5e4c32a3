// SPDX-License-Identifier: MIT
#include "wizard/venue/tile.h"

#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <limits>

#include "theme/theme.h"

namespace relucent::gui {
namespace {

constexpr int besideIcon = 20, besidePicture = 14;
constexpr int belowIcon = 64, leastPicture = 47, underName = 6, belowSentence = 14;

QFont nameFont() {
  return typeOf(type::section, QFont::DemiBold);
}

}  // namespace

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
  setSentence(sentence);
  setAccessibleName(name);
  setFocusPolicy(Qt::StrongFocus);
  QSizePolicy policy(QSizePolicy::Expanding,
                     picture_.isNull() ? QSizePolicy::Preferred : QSizePolicy::Expanding);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
  connect(&Theme::instance(), &Theme::changed, this, qOverload<>(&QWidget::update));
}

void Tile::setSentence(const QString& sentence) {
  sentence_ = sentence;
  setAccessibleDescription(sentence);
  updateGeometry();
  update();
}

int Tile::widthBesideText() const {
  return 2 * (icon_ ? besideIcon : besidePicture);
}

/// Two lines at least, so that names stand beside names.
int Tile::sentenceHeight(int width) const {
  QFontMetrics metrics(typeOf(type::note));
  QRect room(0, 0, std::max(1, width - widthBesideText()), std::numeric_limits<short>::max());
  return std::max(2 * metrics.height(), metrics.boundingRect(room, Qt::TextWordWrap, sentence_).height()) + 4;
}

int Tile::wordsHeight(int width) const {
  int above = icon_ ? belowIcon : leastPicture;
  return above + QFontMetrics(nameFont()).height() + underName + sentenceHeight(width) + belowSentence;
}

int Tile::heightForWidth(int width) const {
  int least = icon_ ? sizeHint().height() : minimumSizeHint().height();
  if (largest_.isValid()) least = std::min(width, largest_.width()) * largest_.height() / largest_.width();
  return std::max(least, wordsHeight(width));
}

QSize Tile::sizeHint() const {
  if (largest_.isValid()) return largest_;
  return {std::max(280, minimumSizeHint().width()), icon_ ? 148 : 240};
}

QSize Tile::minimumSizeHint() const {
  // The name in one line; of the sentence a word, or a sign where words are not apart.
  QRect narrow(0, 0, 1, std::numeric_limits<short>::max());
  int word = QFontMetrics(typeOf(type::note)).boundingRect(narrow, Qt::TextWordWrap, sentence_).width();
  int widest = std::max(word, QFontMetrics(nameFont()).horizontalAdvance(text()));
  return {std::max(140, widest + widthBesideText() + 1), icon_ ? 120 : 160};
}

void Tile::setLargest(QSize size) {
  int width = std::max(size.width(), minimumSizeHint().width());
  largest_ = {width, std::max(size.height(), wordsHeight(width))};
  setMaximumSize(largest_);
  updateGeometry();
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

  QFont bold = nameFont(), small = typeOf(type::note);
  int lines = sentenceHeight(width());
  double textTop = height() - 16.0 - lines - QFontMetrics(bold).height();
  if (icon_) {
    // Where reading begins.
    double left = isRightToLeft() ? width() - 48.0 : 20.0;
    drawIcon(painter, *icon_, QRectF(left, 22, 28, 28), chosen ? c.accent : c.secondary);
    textTop = std::max<double>(belowIcon, (height() - lines) / 2.0 - 2.0);
  } else {
    paintPicture(painter, QRectF(9, 9, width() - 18.0, std::max(20.0, textTop - 18.0)));
  }
  double left = widthBesideText() / 2.0;
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

}  // namespace relucent::gui
