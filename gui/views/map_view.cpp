// SPDX-License-Identifier: MIT
#include "views/map_view.h"

#include <QKeyEvent>

#include "relucent/base/error.h"
#include "theme/theme.h"
#include "views/colour_bar.h"
#include "views/plane_scene.h"
#include "views/relief.h"
#include "views/vtk_view.h"

namespace relucent::gui {
namespace {

enum MapLayer { picture, overlay };

}  // namespace

MapView::MapView(QWidget* parent) : ImageView(parent) {
  if (!VtkView::isPossible()) return;
  useVtk();
  connect(vtk(), &VtkView::refused, this, [this] {
    relief_ = false;
    dropVtk();
  });
  vtk()->installEventFilter(this);
  plane_ = std::make_unique<PlaneScene>(*vtk());
  landscape_ = std::make_unique<Relief>(*vtk());
  plane_->addLayer();
  plane_->addLayer();
}

MapView::~MapView() = default;

void MapView::setValues(image::Image values) {
  require(values.empty() || values.channels() == 1, "{} channels", values.channels());
  values_ = std::move(values);
  risen_ = false;
  if (!canRise()) setRelief(false);
  refresh();
}

void MapView::setRelief(bool relief) {
  relief = relief && canRise();
  if (relief == relief_) return;
  relief_ = relief;
  vtk()->setAttribute(Qt::WA_TransparentForMouseEvents, !relief_);
  refresh();
}

void MapView::arrange() {
  plane_->fill(size());
  plane_->setPicture(MapLayer::picture, ImageView::picture());
  plane_->setPicture(MapLayer::overlay, ImageView::overlay());
  plane_->setShown(!relief_);
  if (relief_ && !std::exchange(risen_, true)) landscape_->set(values_, *scale(), ImageView::picture());
  landscape_->setShown(relief_, width() > 0 ? barArea().width() / width() : 0.0);
  if (!relief_) {
    double brightness = scale() ? 1.0 : Theme::instance().pictureBrightness();
    plane_->place(MapLayer::picture, target(), frame(), brightness, !isEnlarged());
    plane_->place(MapLayer::overlay, target(), frame(), 1.0, false);
  }
  bool bar = scale() && !ImageView::picture().isNull();
  plane_->placeBar(bar ? colourBarIn(barArea()) : QRectF(), scale().value_or(ColourScale()));
}

void MapView::keyPressEvent(QKeyEvent* event) {
  constexpr double degrees = 5.0;
  if (!relief_) return ImageView::keyPressEvent(event);
  switch (event->key()) {
    case Qt::Key_0:
      return landscape_->reset();
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      return landscape_->approach(1.2);
    case Qt::Key_Minus:
      return landscape_->approach(1.0 / 1.2);
    case Qt::Key_Left:
      return landscape_->turn(-degrees, 0.0);
    case Qt::Key_Right:
      return landscape_->turn(degrees, 0.0);
    case Qt::Key_Up:
      return landscape_->turn(0.0, degrees);
    case Qt::Key_Down:
      return landscape_->turn(0.0, -degrees);
    default:
      QWidget::keyPressEvent(event);  // NOLINT(bugprone-parent-virtual-call): the plane is not seen
  }
}

bool MapView::eventFilter(QObject* watched, QEvent* event) {
  if (relief_ && event->type() == QEvent::MouseButtonPress) setFocus(Qt::MouseFocusReason);
  if (relief_ && event->type() == QEvent::MouseButtonDblClick) {
    landscape_->reset();
    return true;
  }
  return ImageView::eventFilter(watched, event);
}

}  // namespace relucent::gui
