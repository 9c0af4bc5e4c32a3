// SPDX-License-Identifier: MIT
#include "wizard/threshold/threshold_pictures.h"

#include <QStackedWidget>

#include "relucent/pipeline/pictures.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/map_view.h"
#include "views/matrix_view.h"
#include "views/number_text.h"
#include "views/view_actions.h"
#include "wizard/devices/device_selector.h"
#include "wizard/frame/page_view.h"
#include "wizard/threshold/threshold_page.h"

namespace relucent::gui {
namespace {

/// What a projector pixel lights, over the surface: the brighter, the less one sees through it.
QImage glowOf(std::span<const float> light, Size size, const QColor& colour) {
  float most = 0.0f;
  for (float value : light) most = std::max(most, value);
  if (!(most > 0.0f)) return {};
  ColourScale scale{ColourMap::viridis, 1e-3 * static_cast<double>(most), static_cast<double>(most), true};
  QImage image(size.width, size.height, QImage::Format_ARGB32);
  for (int y = 0; y < size.height; ++y) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
    for (int x = 0; x < size.width; ++x) {
      double place = scale.place(static_cast<double>(light[indexOf(size, {x, y})]));
      int alpha = place > 0.0 ? static_cast<int>(60.0 + 170.0 * place) : 0;
      line[x] = qRgba(colour.red(), colour.green(), colour.blue(), alpha);
    }
  }
  return image;
}

/// A device's share of what there is of all pixels.
std::span<const float> ofDevice(const std::vector<float>& values, const Rasters& rasters,
                                std::size_t device) {
  return std::span(values).subspan(rasters.offset(device), rasters.size(device).count());
}

/// The surface and the projector's picture, one at a time: a pixel that is picked in one is followed through
/// T into the other.
class DeviceViews : public Card {
 public:
  explicit DeviceViews(ThresholdPage& model) : Card(ThresholdPage::tr("Camera view")), model_(model) {
    flood_ = new MapView;
    flood_->setObjectName("flood-view");
    flood_->setAccessibleName(ThresholdPage::tr("The surface in full light"));
    flood_->setScaleBar(true);
    flood_->setReadout(
        [](QPoint pixel) { return ThresholdPage::tr("Pixel %1, %2").arg(pixel.x()).arg(pixel.y()); });
    print_ = new MapView;
    print_->setObjectName("projector-view");
    print_->setAccessibleName(ThresholdPage::tr("Projector pixels that light the picked camera pixel"));
    print_->setEmptyText(ThresholdPage::tr("Pick a pixel in the camera view."));
    print_->setReadout([this](QPoint pixel) { return readout(pixel); });
    auto* views = new QStackedWidget;
    views->addWidget(flood_);
    views->addWidget(print_);
    body()->addWidget(views, 1);
    addAction(new DeviceSelector(DeviceSelector::Kind::camera, model, this));
    addAction(new DeviceSelector(DeviceSelector::Kind::projector, model, this));
    auto* which = new Segmented({ThresholdPage::tr("Camera"), ThresholdPage::tr("Projector")});
    which->setObjectName("device");
    addAction(which);
    connect(which, &Segmented::chosen, views, &QStackedWidget::setCurrentIndex);
    connect(&flood_->link(), &ViewLink::picked, &model, [this] {
      if (auto pick = flood_->link().pick(); pick && !following_) model_.pick({pick->x(), pick->y()});
    });
    connect(&print_->link(), &ViewLink::picked, &model, [this] {
      if (auto pick = print_->link().pick(); pick && !following_)
        model_.pickProjector({pick->x(), pick->y()});
    });
    refreshOn(
        model, this, [this] { refresh(); }, &ThresholdPage::settingsChanged, &ThresholdPage::resultChanged);
  }

 private:
  QString readout(QPoint pixel) const {
    if (!model_.footprint() || !model_.acquisition()) return {};
    const Rasters& projectors = model_.acquisition()->transport.projectors();
    std::span<const float> shown = ofDevice(model_.footprint()->luminance, projectors, model_.projector());
    const float light = shown[indexOf(projectors.size(model_.projector()), {pixel.x(), pixel.y()})];
    return isolated(
        QString("%1: %2").arg(placeText(pixel.x(), pixel.y()), numberText(static_cast<double>(light))));
  }

  void refresh() {
    flood_->setEmptyText(model_.whyNothing());
    bool otherCamera = std::exchange(camera_, model_.camera()) != model_.camera();
    bool otherProjector = std::exchange(projector_, model_.projector()) != model_.projector();
    shown_ = model_.acquisition();
    if (model_.floodlights() != floodlights_ || otherCamera) {
      floodlights_ = model_.floodlights();
      if (floodlights_ && camera_ < floodlights_->size()) {
        const image::Image& flood = (*floodlights_)[camera_];
        flood_->setPicture(pictureOf(flood, pipeline::displayWhite(flood)));
      } else {
        flood_->setPicture({});
      }
    }
    if (model_.footprint() != footprint_ || otherProjector) showFootprint();
    if (model_.lit() != lit_ || otherCamera) showLit();
    // The other views' picks; theirs to say, not the user's.
    following_ = true;
    show(flood_->link(), model_.picked());
    show(print_->link(), model_.pickedProjector());
    following_ = false;
  }
  static void show(ViewLink& link, const std::optional<Pixel>& pixel) {
    std::optional<QPoint> pick;
    if (pixel) pick = QPoint(pixel->x, pixel->y);
    if (link.pick() != pick) link.setPick(pick);
  }

  void showFootprint() {
    footprint_ = model_.footprint();
    if (!footprint_ || !shown_) return print_->setPicture({});
    const Rasters& projectors = shown_->transport.projectors();
    // One scale for all projectors: they are compared.
    double most = std::max(1e-12, static_cast<double>(footprint_->luminance[footprint_->strongest]));
    ColourScale scale{ColourMap::viridis, most * 1e-4, most, true};
    print_->setScale(scale, ThresholdPage::tr("transport"), false);
    print_->setPicture(
        mapped(ofDevice(footprint_->luminance, projectors, projector_), projectors.size(projector_), scale));
  }

  void showLit() {
    lit_ = model_.lit();
    if (!lit_ || !shown_) return flood_->setOverlay({});
    const Rasters& cameras = shown_->transport.cameras();
    flood_->setOverlay(
        glowOf(ofDevice(*lit_, cameras, camera_), cameras.size(camera_), colours(Look::dark).accent));
  }

  ThresholdPage& model_;
  MapView *flood_, *print_;
  std::shared_ptr<const transport::Acquisition> shown_;
  std::shared_ptr<const std::vector<image::Image>> floodlights_;
  std::shared_ptr<const transport::PixelFootprint> footprint_;
  std::shared_ptr<const std::vector<float>> lit_;
  std::size_t camera_ = 0, projector_ = 0;
  bool following_ = false;
};

/// T, following the cut and the pick.
class MatrixCard : public Card {
 public:
  explicit MatrixCard(ThresholdPage& model) : Card(ThresholdPage::tr("Transport matrix")), model_(model) {
    setSubtitle(ThresholdPage::tr("click an entry"));
    view_ = new MatrixView;
    view_->setObjectName("matrix-view");
    view_->setAccessibleName(
        ThresholdPage::tr("Light transport matrix, camera pixels down, projector pixels across"));
    body()->addWidget(view_, 1);
    addViewActions(*this, *view_, {[view = view_] { return view->values(); }, "camera signal per second"},
                   [&model](const Failure& failure) {
                     Q_EMIT model.failed({failure, ThresholdPage::tr("What is measured is safe.")});
                   });
    connect(&view_->link(), &ViewLink::picked, &model, [this] {
      if (auto pick = view_->link().pick(); pick && !following_)
        model_.pickEntry(static_cast<std::size_t>(pick->y()), static_cast<std::size_t>(pick->x()));
    });
    refreshOn(
        model, this, [this] { refresh(); }, &ThresholdPage::settingsChanged, &ThresholdPage::resultChanged);
  }

 private:
  void refresh() {
    view_->setEmptyText(model_.whyNothing());
    if (model_.matrix() != shown_) {
      shown_ = model_.matrix();
      view_->setMatrix(shown_);
    }
    std::optional<QPoint> pick;
    auto row = model_.pickedRow(), column = model_.pickedColumn();
    if (shown_ && row && column) pick = QPoint(static_cast<int>(*column), static_cast<int>(*row));
    following_ = true;
    if (view_->link().pick() != pick) view_->link().setPick(pick);
    following_ = false;
  }

  ThresholdPage& model_;
  MatrixView* view_;
  std::shared_ptr<const transport::MatrixPictures> shown_;
  bool following_ = false;
};

}  // namespace

QWidget* deviceCard(ThresholdPage& model) {
  return new DeviceViews(model);
}

QWidget* matrixCard(ThresholdPage& model) {
  return new MatrixCard(model);
}

}  // namespace relucent::gui
