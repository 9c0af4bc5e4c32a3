// SPDX-License-Identifier: MIT
#include "views/image_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "theme/icons.h"
#include "theme/theme.h"
#include "views/colour_bar.h"
#include "views/view_tag.h"
#include "views/vtk_view.h"

namespace relucent::gui {
namespace {

constexpr double scaleWidth = 76.0;
constexpr double besideDivider = 10.0, dividerGrip = 60.0;  // the latter at the lower end

}  // namespace

void ImageView::setPicture(const QImage& picture) {
  picture_ = picture;
  refresh();
}

void ImageView::setOverlay(const QImage& overlay) {
  overlay_ = overlay;
  refresh();
}

void ImageView::setScale(const ColourScale& scale, const QString& unit, bool percent) {
  scale_ = scale;
  unit_ = unit;
  percent_ = percent;
  refresh();
}

void ImageView::setCompared(const QImage& right, const QString& leftText, const QString& rightText) {
  compared_ = right;
  leftText_ = leftText;
  rightText_ = rightText;
  refresh();
}

void ImageView::setDivider(double share) {
  divider_ = std::clamp(share, 0.0, 1.0);
  refresh();
}

void ImageView::divideWithin(double left, double right) {
  const QRectF whole = target(), room = frame();
  if (picture_.isNull() || whole.isEmpty() || room.isEmpty()) return;
  const auto shareAt = [&](double column) {
    return (whole.left() + column / picture_.width() * whole.width() - room.left()) / room.width();
  };
  if (divider_ < shareAt(left) || divider_ > shareAt(right)) setDivider(shareAt(0.5 * (left + right)));
}

QRectF ImageView::frame() const {
  const bool hasBar = (scale_ || keepsRoom_) && !picture_.isNull();
  return QRectF(rect()).adjusted(0, 0, hasBar ? -scaleWidth : 0.0, 0);
}

void ImageView::keepRoomForBar() {
  keepsRoom_ = true;
  refresh();
}

QRectF ImageView::barArea() const {
  return QRectF(frame().right(), 0, scaleWidth, height());
}

void ImageView::mousePressEvent(QMouseEvent* event) {
  double x = frame().left() + divider_ * frame().width();
  dividing_ =
      event->button() == Qt::LeftButton && !compared_.isNull() && std::abs(event->position().x() - x) < 12.0;
  if (!dividing_) PlaneView::mousePressEvent(event);
}

void ImageView::mouseMoveEvent(QMouseEvent* event) {
  if (dividing_) return setDivider((event->position().x() - frame().left()) / frame().width());
  PlaneView::mouseMoveEvent(event);
}

void ImageView::mouseReleaseEvent(QMouseEvent* event) {
  if (!std::exchange(dividing_, false)) PlaneView::mouseReleaseEvent(event);
}

void ImageView::paintPlane(QPainter& painter) {
  QRectF whole = target();
  painter.setRenderHint(QPainter::SmoothPixmapTransform, !isEnlarged());
  painter.setOpacity(scale_ ? 1.0 : Theme::instance().pictureBrightness());
  painter.drawImage(whole, picture_);
  if (!compared_.isNull()) {
    painter.save();
    painter.setClipRect(frame().adjusted(divider_ * frame().width(), 0, 0, 0));
    painter.drawImage(whole, compared_);
    painter.restore();
  }
  painter.setOpacity(1.0);
  if (!overlay_.isNull()) painter.drawImage(whole, overlay_);
}

void ImageView::paintOver(QPainter& painter) {
  if (!compared_.isNull()) paintDivider(painter);
  if (!scale_) return;
  if (vtk() == nullptr) drawColourBar(painter, barArea(), *scale_);
  drawColourBarWords(painter, barArea(), *scale_, unit_, percent_);
}

void ImageView::paintDivider(QPainter& painter) {
  double x = frame().left() + divider_ * frame().width();
  painter.setPen(QPen(darkColours().text, 2.0));
  painter.drawLine(QPointF(x, frame().top()), QPointF(x, frame().bottom()));
  painter.setBrush(darkColours().raised);
  painter.drawEllipse(QPointF(x, frame().bottom() - 40.0), 13.0, 13.0);
  drawIcon(painter, Icon::back, QRectF(x - 13.0, frame().bottom() - 47.0, 14.0, 14.0), darkColours().text);
  drawIcon(painter, Icon::next, QRectF(x - 1.0, frame().bottom() - 47.0, 14.0, 14.0), darkColours().text);
  drawTag(painter, dividerTag(false).topLeft(), leftText_, darkColours().secondary);
  drawTag(painter, dividerTag(true).topLeft(), rightText_, darkColours().text);
}

QRectF ImageView::dividerTag(bool right) const {
  QSizeF size = tagSize(right ? rightText_ : leftText_);
  double x = frame().left() + divider_ * frame().width();
  double left = right ? x + besideDivider : x - besideDivider - size.width();
  // At the top, or below what is in the way there.
  std::vector<QPointF> places;
  double y = frame().top() + besideDivider;
  do {
    places.emplace_back(left, y);
    y += size.height() + 4.0;
  } while (y + size.height() < frame().bottom() - dividerGrip);
  return tagBox(size, places, keptFree());
}

}  // namespace relucent::gui
