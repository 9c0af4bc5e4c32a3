// SPDX-License-Identifier: MIT
#include "views/image_view.h"

#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <utility>

#include "theme/icons.h"
#include "theme/theme.h"
#include "views/colour_bar.h"
#include "views/number_text.h"

namespace relucent {
namespace {

constexpr double mostZoom = 64.0, barWidth = 76.0, clickSlop = 4.0;

const Colours& dark() {
  return colours(Look::dark);
}

}  // namespace

void ViewLink::look(double zoom, QPointF centre) {
  zoom_ = std::clamp(zoom, 1.0, mostZoom);
  double margin = 0.5 / zoom_;
  centre_ = {std::clamp(centre.x(), margin, 1.0 - margin), std::clamp(centre.y(), margin, 1.0 - margin)};
  Q_EMIT moved();
}

void ViewLink::setPick(std::optional<QPoint> pick) {
  pick_ = pick;
  Q_EMIT picked();
}

void drawTag(QPainter& painter, QPointF place, const QString& text, const QColor& colour, bool rightAligned) {
  painter.setFont(typeOf(type::note, QFont::DemiBold));
  double width = painter.fontMetrics().horizontalAdvance(text) + 20.0;
  QRectF box(rightAligned ? place.x() - width : place.x(), place.y(), width, 26.0);
  QColor ground = dark().input;
  ground.setAlphaF(0.92f);
  painter.setPen(dark().line);
  painter.setBrush(ground);
  painter.drawRoundedRect(box, 6.0, 6.0);
  painter.setPen(colour);
  painter.drawText(box, Qt::AlignCenter, text);
}

ImageView::ImageView(QWidget* parent) : QWidget(parent) {
  setMinimumSize(120, 90);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setLink(&own_);
  connect(&Theme::instance(), &Theme::changed, this, qOverload<>(&QWidget::update));
}

void ImageView::setLink(ViewLink* link) {
  link_->disconnect(this);
  link_ = link;
  connect(link_, &ViewLink::moved, this, qOverload<>(&QWidget::update));
  connect(link_, &ViewLink::picked, this, qOverload<>(&QWidget::update));
  update();
}

void ImageView::setPicture(const QImage& picture) {
  picture_ = picture;
  update();
}

void ImageView::setOverlay(const QImage& overlay) {
  overlay_ = overlay;
  update();
}

void ImageView::setScale(const ColourScale& scale, const QString& unit, bool percent) {
  scale_ = scale;
  unit_ = unit;
  percent_ = percent;
  update();
}

void ImageView::setReadout(Readout readout) {
  readout_ = std::move(readout);
  update();
}

void ImageView::setEmptyText(const QString& text) {
  emptyText_ = text;
  update();
}

void ImageView::setBadge(const QString& text) {
  badge_ = text;
  update();
}

void ImageView::setScaleBar(bool shown) {
  scaleBar_ = shown;
  update();
}

void ImageView::setCompared(const QImage& right, const QString& leftText, const QString& rightText) {
  compared_ = right;
  leftText_ = leftText;
  rightText_ = rightText;
  update();
}

void ImageView::setDivider(double share) {
  divider_ = std::clamp(share, 0.0, 1.0);
  update();
}

QRectF ImageView::frame() const {
  return QRectF(rect()).adjusted(0, 0, scale_ && !picture_.isNull() ? -barWidth : 0.0, 0);
}

double ImageView::fittingScale() const {
  if (picture_.isNull()) return 1.0;
  return std::min(frame().width() / picture_.width(), frame().height() / picture_.height());
}

QRectF ImageView::target() const {
  double scale = fittingScale() * link_->zoom();
  QSizeF size = QSizeF(picture_.size()) * scale;
  // What fits whole stays in the middle; what does not is looked at where the link says.
  auto origin = [](double middle, double extent, double room, double centre) {
    return extent <= room
               ? middle - extent / 2.0
               : std::clamp(middle - centre * extent, middle + room / 2.0 - extent, middle - room / 2.0);
  };
  QRectF area = frame();
  return QRectF(QPointF(origin(area.center().x(), size.width(), area.width(), link_->centre().x()),
                        origin(area.center().y(), size.height(), area.height(), link_->centre().y())),
                size);
}

QPointF ImageView::widgetFromPicture(QPointF place) const {
  QRectF whole = target();
  return {whole.left() + place.x() / picture_.width() * whole.width(),
          whole.top() + place.y() / picture_.height() * whole.height()};
}

QPointF ImageView::pictureFromWidget(QPointF place) const {
  QRectF whole = target();
  return {(place.x() - whole.left()) / whole.width() * picture_.width(),
          (place.y() - whole.top()) / whole.height() * picture_.height()};
}

std::optional<QPoint> ImageView::pixelAt(QPointF widgetPlace) const {
  if (picture_.isNull() || !frame().contains(widgetPlace)) return std::nullopt;
  QPointF place = pictureFromWidget(widgetPlace);
  QPoint pixel(static_cast<int>(std::floor(place.x())), static_cast<int>(std::floor(place.y())));
  if (!picture_.rect().contains(pixel)) return std::nullopt;
  return pixel;
}

void ImageView::zoomAt(QPointF place, double factor) {
  if (picture_.isNull()) return;
  QRectF before = target();
  QPointF share((place.x() - before.left()) / before.width(), (place.y() - before.top()) / before.height());
  double zoom = std::clamp(link_->zoom() * factor, 1.0, mostZoom);
  QSizeF size = QSizeF(picture_.size()) * fittingScale() * zoom;
  // The same place of the picture stays under the pointer.
  QPointF centre(share.x() + (frame().center().x() - place.x()) / size.width(),
                 share.y() + (frame().center().y() - place.y()) / size.height());
  link_->look(zoom, centre);
}

void ImageView::wheelEvent(QWheelEvent* event) {
  zoomAt(event->position(), std::pow(1.2, event->angleDelta().y() / 120.0));
}

void ImageView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  pressed_ = lastDrag_ = event->position();
  dragging_ = true;
  double x = frame().left() + divider_ * frame().width();
  dividing_ = !compared_.isNull() && std::abs(event->position().x() - x) < 12.0;
}

void ImageView::mouseMoveEvent(QMouseEvent* event) {
  if (!dragging_) {
    std::optional<QPoint> pixel = pixelAt(event->position());
    setToolTip(pixel && readout_ ? readout_(*pixel) : QString());
    return;
  }
  QPointF step = event->position() - lastDrag_;
  lastDrag_ = event->position();
  if (dividing_) return setDivider((event->position().x() - frame().left()) / frame().width());
  QRectF whole = target();
  link_->look(link_->zoom(), link_->centre() - QPointF(step.x() / whole.width(), step.y() / whole.height()));
}

void ImageView::mouseReleaseEvent(QMouseEvent* event) {
  bool click = (event->position() - pressed_).manhattanLength() < clickSlop;
  if (std::exchange(dragging_, false) && click && !dividing_)
    if (std::optional<QPoint> pixel = pixelAt(event->position())) link_->setPick(pixel);
  dividing_ = false;
}

void ImageView::mouseDoubleClickEvent(QMouseEvent*) {
  link_->look(1.0, {0.5, 0.5});
}

void ImageView::movePick(int dx, int dy) {
  if (picture_.isNull()) return;
  QPoint from = link_->pick().value_or(picture_.rect().center());
  QPoint to(std::clamp(from.x() + dx, 0, picture_.width() - 1),
            std::clamp(from.y() + dy, 0, picture_.height() - 1));
  link_->setPick(to);
}

void ImageView::keyPressEvent(QKeyEvent* event) {
  QPointF middle = frame().center();
  switch (event->key()) {
    case Qt::Key_0:
      return link_->look(1.0, {0.5, 0.5});
    case Qt::Key_1:
      return link_->look(1.0 / fittingScale(), link_->centre());
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      return zoomAt(middle, 1.5);
    case Qt::Key_Minus:
      return zoomAt(middle, 1.0 / 1.5);
    case Qt::Key_Left:
      return movePick(-1, 0);
    case Qt::Key_Right:
      return movePick(1, 0);
    case Qt::Key_Up:
      return movePick(0, -1);
    case Qt::Key_Down:
      return movePick(0, 1);
    default:
      QWidget::keyPressEvent(event);
  }
}

void ImageView::paintPicture(QPainter& painter) {
  QRectF whole = target();
  painter.setRenderHint(QPainter::SmoothPixmapTransform, fittingScale() * link_->zoom() < 1.0);
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

void ImageView::paintDivider(QPainter& painter) {
  double x = frame().left() + divider_ * frame().width();
  painter.setPen(QPen(dark().text, 2.0));
  painter.drawLine(QPointF(x, frame().top()), QPointF(x, frame().bottom()));
  painter.setBrush(dark().raised);
  painter.drawEllipse(QPointF(x, frame().bottom() - 40.0), 13.0, 13.0);
  drawIcon(painter, Icon::back, QRectF(x - 13.0, frame().bottom() - 47.0, 14.0, 14.0), dark().text);
  drawIcon(painter, Icon::next, QRectF(x - 1.0, frame().bottom() - 47.0, 14.0, 14.0), dark().text);
  drawTag(painter, {x - 10.0, frame().top() + 10.0}, leftText_, dark().secondary, true);
  drawTag(painter, {x + 10.0, frame().top() + 10.0}, rightText_, dark().text);
}

void ImageView::paintPick(QPainter& painter) {
  std::optional<QPoint> pick = link_->pick();
  if (!pick || !picture_.rect().contains(*pick)) return;
  QPointF place = widgetFromPicture(QPointF(*pick) + QPointF(0.5, 0.5));
  if (!frame().contains(place)) return;
  for (auto [colour, width] : {std::pair(dark().picture, 4.0), std::pair(dark().accent, 2.0)}) {
    painter.setPen(QPen(colour, width));
    painter.setBrush(Qt::NoBrush);
    painter.drawEllipse(place, 7.0, 7.0);
    for (QPointF step : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
      painter.drawLine(place + 7.0 * step, place + 15.0 * step);
  }
  if (!readout_) return;
  QString text = readout_(*pick);
  bool right = place.x() > frame().center().x();
  double y = place.y() > frame().top() + 50.0 ? place.y() - 46.0 : place.y() + 20.0;
  drawTag(painter, {right ? place.x() - 12.0 : place.x() + 12.0, y}, text, dark().text, right);
}

void ImageView::paintScaleBar(QPainter& painter) {
  double pixel = fittingScale() * link_->zoom();
  double wanted = 70.0 / pixel;
  double power = std::pow(10.0, std::floor(std::log10(std::max(wanted, 1.0))));
  double length = wanted >= 5.0 * power ? 5.0 * power : wanted >= 2.0 * power ? 2.0 * power : power;
  QRectF box(frame().left() + 12.0, frame().bottom() - 46.0, length * pixel + 24.0, 34.0);
  if (box.right() > frame().right()) return;
  QColor ground = dark().input;
  ground.setAlphaF(0.85f);
  painter.setPen(Qt::NoPen);
  painter.setBrush(ground);
  painter.drawRoundedRect(box, 6.0, 6.0);
  painter.setFont(typeOf(type::axis, QFont::DemiBold));
  painter.setPen(dark().text);
  painter.drawText(box.adjusted(0, 3, 0, -12), Qt::AlignCenter, tr("%1 px").arg(length));
  painter.drawLine(QPointF(box.left() + 12.0, box.bottom() - 8.0),
                   QPointF(box.right() - 12.0, box.bottom() - 8.0));
}

void ImageView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QPainterPath shape;
  shape.addRoundedRect(QRectF(rect()), 4.0, 4.0);
  painter.setClipPath(shape);
  painter.fillRect(rect(), dark().picture);
  if (picture_.isNull()) {
    painter.setPen(dark().secondary);
    painter.setFont(typeOf(type::body));
    painter.drawText(QRectF(rect()).adjusted(24, 24, -24, -24), Qt::AlignCenter | Qt::TextWordWrap,
                     emptyText_);
  } else {
    painter.save();
    painter.setClipRect(frame(), Qt::IntersectClip);
    paintPicture(painter);
    if (!compared_.isNull()) paintDivider(painter);
    if (scaleBar_) paintScaleBar(painter);
    paintPick(painter);
    if (!badge_.isEmpty()) drawTag(painter, {12.0, 12.0}, badge_, dark().amber);
    painter.restore();
    if (scale_)
      drawColourBar(painter, QRectF(frame().right(), 0, barWidth, height()), *scale_, unit_, percent_);
  }
  if (hasFocus()) {
    painter.setPen(QPen(dark().text, 2.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4.0, 4.0);
  }
}

}  // namespace relucent
