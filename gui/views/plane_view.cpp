// SPDX-License-Identifier: MIT
#include "views/plane_view.h"

#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <utility>

#include "theme/theme.h"
#include "views/vtk_view.h"

namespace relucent {
namespace {

constexpr double clickSlop = 4.0, cornerRadius = 4.0;

const Colours& dark() {
  return colours(Look::dark);
}

}  // namespace

void ViewLink::look(double zoom, QPointF centre) {
  zoom_ = std::clamp(zoom, 1.0, mostZoom_);
  double margin = 0.5 / zoom_;
  centre_ = {std::clamp(centre.x(), margin, 1.0 - margin), std::clamp(centre.y(), margin, 1.0 - margin)};
  Q_EMIT moved();
}

void ViewLink::setPick(std::optional<QPoint> pick) {
  pick_ = pick;
  Q_EMIT picked();
}

QSizeF tagSize(const QString& text) {
  return QFontMetricsF(typeOf(type::note, QFont::DemiBold)).size(0, text) + QSizeF(20.0, 10.0);
}

void drawTag(QPainter& painter, QPointF place, const QString& text, const QColor& colour, bool rightAligned) {
  painter.setFont(typeOf(type::note, QFont::DemiBold));
  QSizeF size = tagSize(text);
  double width = size.width();
  QRectF box(QPointF(rightAligned ? place.x() - width : place.x(), place.y()), size);
  if (painter.hasClipping()) {
    // What is to be read lies where it can be.
    QRectF seen = painter.clipBoundingRect();
    box.moveLeft(std::max(seen.left() + 2.0, std::min(box.left(), seen.right() - width - 2.0)));
  }
  QColor ground = dark().input;
  ground.setAlphaF(0.92f);
  painter.setPen(dark().line);
  painter.setBrush(ground);
  painter.drawRoundedRect(box, 6.0, 6.0);
  painter.setPen(colour);
  painter.drawText(box, Qt::AlignCenter, text);
}

/// Lies over the scene that VTK draws and bears what is painted.
class PlaneView::Glass : public QWidget {
 public:
  explicit Glass(PlaneView& view) : QWidget(&view), view_(view) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    view_.paintWords(painter);
    // The scene is rectangular; its corners are the card's.
    QPainterPath corners;
    corners.addRect(QRectF(rect()));
    QPainterPath shape;
    shape.addRoundedRect(QRectF(rect()), cornerRadius, cornerRadius);
    painter.fillPath(corners.subtracted(shape), colours().card);
  }

 private:
  PlaneView& view_;
};

PlaneView::PlaneView(QWidget* parent) : QWidget(parent) {
  setMinimumSize(120, 90);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setLink(&own_);
  connect(&Theme::instance(), &Theme::changed, this, [this] { refresh(); });
}

PlaneView::~PlaneView() = default;

void PlaneView::useVtk() {
  vtk_ = new VtkView(this);
  vtk_->setFocusPolicy(Qt::NoFocus);
  vtk_->setAttribute(Qt::WA_TransparentForMouseEvents);
  glass_ = new Glass(*this);
  glass_->setVisible(vtk_->works());
  connect(vtk_, &VtkView::refused, glass_, &QWidget::hide);
}

void PlaneView::dropVtk() {
  if (vtk_ == nullptr) return;
  vtk_->hide();
  std::exchange(vtk_, nullptr)->deleteLater();
  std::exchange(glass_, nullptr)->deleteLater();
  update();
}

void PlaneView::refresh() {
  if (vtk_ == nullptr || !vtk_->works()) return update();
  arrange();
  vtk_->redraw();
  glass_->update();
}

void PlaneView::setLink(ViewLink* link) {
  link_->disconnect(this);
  link_ = link;
  connect(link_, &ViewLink::moved, this, [this] { refresh(); });
  connect(link_, &ViewLink::picked, this, [this] {
    if (readout_ && link_->pick()) setAccessibleDescription(readout_(*link_->pick()));
    refresh();
  });
  refresh();
}

void PlaneView::setReadout(Readout readout) {
  readout_ = std::move(readout);
  refresh();
}

void PlaneView::setEmptyText(const QString& text) {
  emptyText_ = text;
  refresh();
}

void PlaneView::setBadge(const QString& text) {
  badge_ = text;
  refresh();
}

void PlaneView::setScaleBar(bool shown) {
  scaleBar_ = shown;
  refresh();
}

QSizeF PlaneView::fit() const {
  QSize plane = planeSize();
  if (plane.isEmpty()) return {1.0, 1.0};
  double across = frame().width() / plane.width(), down = frame().height() / plane.height();
  if (!keepsAspect()) return {across, down};
  return {std::min(across, down), std::min(across, down)};
}

QRectF PlaneView::target() const {
  QSizeF size(fit().width() * link_->zoom() * planeSize().width(),
              fit().height() * link_->zoom() * planeSize().height());
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

QPointF PlaneView::widgetFromPicture(QPointF place) const {
  QRectF whole = target();
  return {whole.left() + place.x() / planeSize().width() * whole.width(),
          whole.top() + place.y() / planeSize().height() * whole.height()};
}

QPointF PlaneView::pictureFromWidget(QPointF place) const {
  QRectF whole = target();
  return {(place.x() - whole.left()) / whole.width() * planeSize().width(),
          (place.y() - whole.top()) / whole.height() * planeSize().height()};
}

std::optional<QPoint> PlaneView::pixelAt(QPointF widgetPlace) const {
  if (planeSize().isEmpty() || !frame().contains(widgetPlace)) return std::nullopt;
  QPointF place = pictureFromWidget(widgetPlace);
  QPoint pixel(static_cast<int>(std::floor(place.x())), static_cast<int>(std::floor(place.y())));
  if (!QRect(QPoint(), planeSize()).contains(pixel)) return std::nullopt;
  return pixel;
}

QImage PlaneView::asSeen() {
  return grab().toImage();
}

void PlaneView::zoomAt(QPointF place, double factor) {
  if (planeSize().isEmpty()) return;
  QRectF before = target();
  QPointF share((place.x() - before.left()) / before.width(), (place.y() - before.top()) / before.height());
  double zoom = std::clamp(link_->zoom() * factor, 1.0, link_->mostZoom());
  QSizeF size(before.width() * zoom / link_->zoom(), before.height() * zoom / link_->zoom());
  // The same place of the plane stays under the pointer.
  QPointF centre(share.x() + (frame().center().x() - place.x()) / size.width(),
                 share.y() + (frame().center().y() - place.y()) / size.height());
  look(zoom, centre);
}

void PlaneView::wheelEvent(QWheelEvent* event) {
  zoomAt(event->position(), std::pow(1.2, event->angleDelta().y() / 120.0));
  event->accept();
}

void PlaneView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  pressed_ = lastDrag_ = event->position();
  dragging_ = true;
}

void PlaneView::mouseMoveEvent(QMouseEvent* event) {
  if (std::optional<QPoint> under = pixelAt(event->position()); under != hovered_) {
    hovered_ = under;
    if (glass_ != nullptr)
      glass_->update();
    else
      update();
  }
  if (!dragging_ || planeSize().isEmpty()) return;
  QPointF step = event->position() - lastDrag_;
  lastDrag_ = event->position();
  QRectF whole = target();
  look(link_->zoom(), link_->centre() - QPointF(step.x() / whole.width(), step.y() / whole.height()));
}

void PlaneView::mouseReleaseEvent(QMouseEvent* event) {
  bool click = (event->position() - pressed_).manhattanLength() < clickSlop;
  if (std::exchange(dragging_, false) && click)
    if (std::optional<QPoint> pixel = pixelAt(event->position())) link_->setPick(pixel);
}

void PlaneView::mouseDoubleClickEvent(QMouseEvent*) {
  look(1.0, {0.5, 0.5});
}

bool PlaneView::event(QEvent* event) {
  if (event->type() == QEvent::Leave && hovered_) {
    hovered_.reset();
    refresh();
  }
  if (event->type() == QEvent::FocusIn || event->type() == QEvent::FocusOut || event->type() == QEvent::Show)
    refresh();
  return QWidget::event(event);
}

void PlaneView::resizeEvent(QResizeEvent* event) {
  if (vtk_ != nullptr) {
    vtk_->setGeometry(rect());
    glass_->setGeometry(rect());
    glass_->raise();
  }
  refresh();
  QWidget::resizeEvent(event);
}

void PlaneView::movePick(int dx, int dy) {
  if (planeSize().isEmpty()) return;
  QRect plane(QPoint(), planeSize());
  QPoint from = link_->pick().value_or(plane.center());
  QPoint to(std::clamp(from.x() + dx, 0, plane.width() - 1),
            std::clamp(from.y() + dy, 0, plane.height() - 1));
  link_->setPick(to);
}

void PlaneView::keyPressEvent(QKeyEvent* event) {
  QPointF middle = frame().center();
  int step = event->modifiers().testFlag(Qt::ShiftModifier) ? 10 : 1;
  switch (event->key()) {
    case Qt::Key_0:
      return look(1.0, {0.5, 0.5});
    case Qt::Key_1:
      return look(1.0 / (std::min(fit().width(), fit().height()) * devicePixelRatioF()), link_->centre());
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      return zoomAt(middle, 1.5);
    case Qt::Key_Minus:
      return zoomAt(middle, 1.0 / 1.5);
    case Qt::Key_Left:
      return movePick(-step, 0);
    case Qt::Key_Right:
      return movePick(step, 0);
    case Qt::Key_Up:
      return movePick(0, -step);
    case Qt::Key_Down:
      return movePick(0, step);
    default:
      QWidget::keyPressEvent(event);
  }
}

void PlaneView::paintPick(QPainter& painter) {
  std::optional<QPoint> pick = link_->pick();
  if (!pick || !QRect(QPoint(), planeSize()).contains(*pick)) return;
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
  if (text.isEmpty()) return;
  bool right = place.x() > frame().center().x();
  double height = tagSize(text).height();
  bool above = place.y() > frame().top() + height + 24.0;
  double y = above ? place.y() - height - 20.0 : place.y() + 20.0;
  drawTag(painter, {right ? place.x() - 12.0 : place.x() + 12.0, y}, text, dark().text, right);
}

void PlaneView::paintScaleBar(QPainter& painter) {
  double pixel = fit().width() * link_->zoom();
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

/// Everything but the plane itself.
void PlaneView::paintWords(QPainter& painter) {
  if (planeSize().isEmpty()) {
    painter.setPen(dark().secondary);
    painter.setFont(typeOf(type::body));
    painter.drawText(QRectF(rect()).adjusted(24, 24, -24, -24), Qt::AlignCenter | Qt::TextWordWrap,
                     emptyText_);
  } else {
    paintOver(painter);
    if (isFlat()) paintMarks(painter);
  }
  if (!hasFocus()) return;
  painter.setPen(QPen(dark().text, 2.0));
  painter.setBrush(Qt::NoBrush);
  painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), cornerRadius, cornerRadius);
}

void PlaneView::paintMarks(QPainter& painter) {
  painter.save();
  painter.setClipRect(frame(), Qt::IntersectClip);
  if (scaleBar_) paintScaleBar(painter);
  paintPick(painter);
  if (!badge_.isEmpty()) drawTag(painter, frame().topLeft() + QPointF(12.0, 12.0), badge_, dark().amber);
  if (hovered_ && readout_ && hovered_ != link_->pick())
    if (QString text = readout_(*hovered_); !text.isEmpty())
      drawTag(painter, frame().bottomRight() - QPointF(12.0, 12.0 + tagSize(text).height()), text,
              dark().text, true);
  painter.restore();
}

void PlaneView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QPainterPath shape;
  shape.addRoundedRect(QRectF(rect()), cornerRadius, cornerRadius);
  painter.setClipPath(shape);
  painter.fillRect(rect(), dark().picture);
  if (vtk_ != nullptr) return;
  if (!planeSize().isEmpty()) {
    painter.save();
    painter.setClipRect(frame(), Qt::IntersectClip);
    paintPlane(painter);
    painter.restore();
  }
  paintWords(painter);
}

}  // namespace relucent
