// SPDX-License-Identifier: MIT
#include <QSlider>
#include <cmath>

#include "pipeline/pictures.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/cut_histogram.h"
#include "views/image_view.h"
#include "views/number_text.h"
#include "wizard/cluster_page.h"
#include "wizard/page_view.h"

namespace relucent {
namespace {

/// Clusters over the flood image: its brightness, the clusters' tints, borders dark.
QImage mapOf(const ClusterResult& result, const QImage& flood) {
  QImage image(flood.size(), QImage::Format_RGB32);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      std::size_t at = indexOf(result.camera, {x, y});
      QColor under(flood.pixel(x, y));
      if (result.map[at] == noCluster) {
        image.setPixelColor(x, y, QColor(under.red() / 4, under.green() / 4, under.blue() / 4));
        continue;
      }
      const QColor& tint = clusterPalette[result.colours[result.map[at]]];
      double light = (result.borders[at] != 0 ? 0.45 : 1.0) * (0.3 + 0.7 * qGray(under.rgb()) / 255.0);
      auto mix = [light](int a, int b) {
        return std::clamp(static_cast<int>(light * (0.75 * a + 0.25 * b)), 0, 255);
      };
      image.setPixelColor(x, y,
                          QColor(mix(tint.red(), under.red()), mix(tint.green(), under.green()),
                                 mix(tint.blue(), under.blue())));
    }
  return image;
}

std::vector<CutHistogram::Bar> barsOf(const std::vector<ClusterSize>& sizes) {
  std::vector<CutHistogram::Bar> bars;
  for (double from = 1.0; from < 1024.0; from *= 2.0) bars.push_back({from, 2.0 * from, 0.0});
  for (const ClusterSize& size : sizes) {
    if (size.unknowns == 0) continue;
    auto bin = std::min(static_cast<std::size_t>(std::log2(size.unknowns)), bars.size() - 1);
    bars[bin].count += 1.0;
  }
  return bars;
}

class ClusterStage : public QWidget {
 public:
  explicit ClusterStage(ClusterPage& model) : model_(model) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(space::gap);
    auto* row = new QHBoxLayout;
    row->setSpacing(space::gap);
    auto* mapCard = new Card(ClusterPage::tr("Cluster map"));
    mapCard->setSubtitle(ClusterPage::tr("over the surface in full light"));
    auto* errorCard = new Card(ClusterPage::tr("Error for each camera pixel"));
    map_ = new ImageView;
    error_ = new ImageView;
    map_->setObjectName("cluster-view");
    error_->setObjectName("error-view");
    map_->setScaleBar(true);
    map_->setLink(&link_);
    error_->setLink(&link_);
    for (ImageView* view : {map_, error_}) {
      view->setEmptyText(ClusterPage::tr("Grouping"));
      view->setReadout([this](QPoint pixel) { return readout(pixel); });
    }
    mapCard->body()->addWidget(map_, 1);
    errorCard->body()->addWidget(error_, 1);
    row->addWidget(mapCard, 1);
    row->addWidget(errorCard, 1);
    column->addLayout(row, 5);
    sizeCard_ = new Card(ClusterPage::tr("Cluster sizes"));
    sizes_ = new CutHistogram({1.0, 1024.0, true, ClusterPage::tr("Projector pixels in the cluster")},
                              ClusterPage::tr("Clusters"));
    sizes_->setMovable(false);
    sizes_->setFocusPolicy(Qt::NoFocus);
    sizeCard_->body()->addWidget(sizes_, 1);
    column->addWidget(sizeCard_, 3);
    connect(&model_, &ClusterPage::changed, this, [this] { refresh(); });
    refresh();
  }

 private:
  QString readout(QPoint pixel) const {
    const auto& result = model_.result();
    if (!result) return {};
    std::size_t at = indexOf(result->camera, {pixel.x(), pixel.y()});
    if (result->map[at] == noCluster)
      return ClusterPage::tr("%1, %2: in no cluster").arg(pixel.x()).arg(pixel.y());
    return ClusterPage::tr("%1, %2: %3 projector pixels, error %4")
        .arg(pixel.x())
        .arg(pixel.y())
        .arg(result->sizes[result->map[at]].unknowns)
        .arg(percentText(static_cast<double>(result->error[at])));
  }
  void refresh() {
    const auto& result = model_.result();
    if (result == shown_) return;
    shown_ = result;
    if (!result || !model_.acquisition()) {
      map_->setPicture({});
      return error_->setPicture({});
    }
    Image flood = imageFromStack(model_.acquisition()->flood, model_.acquisition()->transport.cameras(), 0);
    map_->setPicture(mapOf(*result, pictureOf(flood, displayWhite(flood))));
    map_->setAccessibleName(ClusterPage::tr("Cluster map, %1 clusters, largest %2")
                                .arg(countText(result->sizes.size()))
                                .arg(result->statistics.largest));
    double high = std::max(0.1, std::min(1.0, result->statistics.errorP95 * 1.1));
    ColourScale scale{ColourMap::cividis, 0.0, high, false};
    error_->setScale(scale, ClusterPage::tr("rel. RMS"), true);
    error_->setPicture(mapped(result->error, result->camera, scale));
    error_->setAccessibleName(
        ClusterPage::tr("Error map, median %1").arg(percentText(result->statistics.errorMedian)));
    sizes_->setBars(barsOf(result->sizes));
    sizes_->setCut(model_.settings().mostUnknowns);
    sizes_->setCutText(ClusterPage::tr("cap %1").arg(model_.settings().mostUnknowns));
    sizeCard_->setSubtitle(ClusterPage::tr("%1 clusters, median %2")
                               .arg(countText(result->sizes.size()))
                               .arg(result->statistics.medianUnknowns));
  }

  ClusterPage& model_;
  ViewLink link_;
  ImageView *map_, *error_;
  Card* sizeCard_;
  CutHistogram* sizes_;
  std::shared_ptr<const ClusterResult> shown_;
};

/// A slider with its name, value, and what its ends mean.
class SliderPart : public QWidget {
 public:
  SliderPart(const QString& name, const QString& left, const QString& right, int least, int most) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(4);
    column->addWidget(row = new ValueRow(name));
    column->addWidget(slider = new QSlider(Qt::Horizontal));
    slider->setRange(least, most);
    slider->setAccessibleName(name);
    auto* ends = new QHBoxLayout;
    ends->addWidget(labelOf(left, "note"));
    ends->addStretch(1);
    ends->addWidget(labelOf(right, "note"));
    for (int i : {0, 2})
      if (auto* label = qobject_cast<QLabel*>(ends->itemAt(i)->widget())) label->setWordWrap(false);
    column->addLayout(ends);
  }
  void set(int value, const QString& text) {
    QSignalBlocker quiet(slider);
    slider->setValue(value);
    row->setValue(text);
  }
  ValueRow* row;
  QSlider* slider;
};

QWidget* inspectorOf(ClusterPage& model) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  auto* distance = new SliderPart(ClusterPage::tr("Distance"), ClusterPage::tr("small, sharp"),
                                  ClusterPage::tr("large, fast"), 2, 16);
  auto* share = new SliderPart(ClusterPage::tr("Share of the brightest"), ClusterPage::tr("more detail"),
                               ClusterPage::tr("more speed"), 10, 90);
  auto* largest = new SliderPart(ClusterPage::tr("Largest cluster"), ClusterPage::tr("fast"),
                                 ClusterPage::tr("exact"), 2, 32);
  distance->slider->setObjectName("distance");
  for (SliderPart* part : {distance, share, largest}) column->addWidget(part);
  column->addWidget(lineOf());
  column->addWidget(labelOf(ClusterPage::tr("Result"), "section"));
  auto* clusters = new ValueRow(ClusterPage::tr("Clusters"));
  auto* cut = new ValueRow(ClusterPage::tr("Cut by the cap"));
  auto* kept = new ValueRow(ClusterPage::tr("Light kept in clusters"));
  auto* error = new ValueRow(ClusterPage::tr("Median error"));
  for (ValueRow* row : {clusters, cut, kept, error}) column->addWidget(row);
  auto* normal = new Note(Note::Kind::information);
  normal->setText(
      ClusterPage::tr("An error of 70 to 80 % is normal here."),
      ClusterPage::tr(
          "Grouping drops the blur of the lens on purpose. Look for patches that stand out from their "
          "surroundings."));
  column->addWidget(normal);
  auto* percolated = new Note(Note::Kind::amber);
  column->addWidget(percolated);
  column->addStretch(1);

  auto change = [&model](auto apply) {
    ClusteringSettings settings = model.settings();
    apply(settings);
    model.setSettings(settings);
  };
  QObject::connect(distance->slider, &QSlider::valueChanged, &model, [change](int value) {
    change([value](ClusteringSettings& s) { s.patchRadius = value; });
  });
  QObject::connect(share->slider, &QSlider::valueChanged, &model, [change](int value) {
    change([value](ClusteringSettings& s) { s.patchCut = value / 100.0; });
  });
  QObject::connect(largest->slider, &QSlider::valueChanged, &model, [change](int value) {
    change([value](ClusteringSettings& s) { s.mostUnknowns = 16 * value; });
  });
  auto refresh = [=, &model] {
    const ClusteringSettings& settings = model.settings();
    distance->set(static_cast<int>(settings.patchRadius), ClusterPage::tr("%1 px").arg(settings.patchRadius));
    share->set(static_cast<int>(std::lround(100.0 * settings.patchCut)), percentText(settings.patchCut));
    largest->set(settings.mostUnknowns / 16,
                 ClusterPage::tr("%n unknown(s)", nullptr, settings.mostUnknowns));
    const auto& result = model.result();
    percolated->setVisible(false);
    if (!result) return;
    const ClusteringStatistics& s = result->statistics;
    clusters->setValue(countText(result->sizes.size()));
    cut->setValue(ClusterPage::tr("%1 of light").arg(percentText(s.cutByCap)));
    kept->setValue(percentText(s.keptLight));
    error->setValue(percentText(s.errorMedian));
    double joined =
        s.litProjectorPixels > 0 ? s.largestBeforeCap / static_cast<double>(s.litProjectorPixels) : 0.0;
    percolated->setVisible(joined > 0.2);
    percolated->setText(
        ClusterPage::tr("Without the cap, one cluster would cover %1 of the picture.")
            .arg(percentText(joined)),
        ClusterPage::tr("The surface is blurred across neighbouring pixels, so groups join up. The cap keeps "
                        "them apart."));
  };
  QObject::connect(&model, &ClusterPage::changed, card, refresh);
  refresh();
  return card;
}

}  // namespace

PageView viewOf(ClusterPage& model) {
  return {new ClusterStage(model), inspectorOf(model)};
}

}  // namespace relucent
