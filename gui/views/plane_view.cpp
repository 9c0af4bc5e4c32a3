// SPDX-License-Identifier: MIT
#include "views/plane_view.h"

#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <utility>

#include "theme/accessible_role.h"
#include "theme/theme.h"
#include "views/vtk_view.h"
#include "views/whole_screen.h"

namespace relucent::gui {
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
    if (view_.saving_) return;
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
  setAccessibleRole(this, QAccessible::Graphic);
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
  // Scene and glass cover every pixel: what lies behind is not painted for each frame.
  setAttribute(Qt::WA_OpaquePaintEvent, vtk_->works());
  connect(vtk_, &VtkView::refused, this, [this] {
    setAttribute(Qt::WA_OpaquePaintEvent, false);
    glass_->hide();
  });
}

void PlaneView::dropVtk() {
  if (vtk_ == nullptr) return;
  setAttribute(Qt::WA_OpaquePaintEvent, false);
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

void PlaneView::refreshWords() {
  glass_ != nullptr ? glass_->update() : update();
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

void PlaneView::setCaption(const QString& text) {
  if (caption_ == text) return;
  caption_ = text;
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
  saving_ = true;
  QImage seen = grab().toImage();
  saving_ = false;
  return seen;
}

void PlaneView::setWholeScreen(bool whole) {
  if (whole == isWholeScreen()) return;
  if (whole)
    whole_ = new WholeScreen(*this);
  else
    std::exchange(whole_, nullptr)->close();
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

void PlaneView::paintEvent(QPaintEvent*) {
  if (vtk_ != nullptr && vtk_->works()) return;  // the scene covers it
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  QPainterPath shape;
  shape.addRoundedRect(QRectF(rect()), cornerRadius, cornerRadius);
  if (!saving_) painter.setClipPath(shape);
  painter.fillRect(rect(), darkColours().picture);
  if (vtk_ != nullptr) return;
  if (!planeSize().isEmpty()) {
    painter.save();
    painter.setClipRect(frame(), Qt::IntersectClip);
    paintPlane(painter);
    painter.restore();
  }
  paintWords(painter);
}

}  // namespace relucent::gui
