// SPDX-License-Identifier: MIT
#include "wizard/cluster/cluster_view.h"

#include <QSlider>
#include <cmath>

#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/folding_rows.h"
#include "theme/theme.h"
#include "views/cut_histogram.h"
#include "views/map_view.h"
#include "views/number_text.h"
#include "views/view_actions.h"
#include "wizard/cluster/cluster_picture.h"
#include "wizard/devices/device_selector.h"

namespace relucent::gui {
namespace {

std::vector<CutHistogram::Bar> barsOf(const std::vector<clustering::ClusterSize>& sizes) {
  std::vector<CutHistogram::Bar> bars;
  for (double from = 1.0; from < 1024.0; from *= 2.0) bars.push_back({from, 2.0 * from, 0.0});
  for (const clustering::ClusterSize& size : sizes) {
    if (size.unknowns == 0) continue;
    // The upper end is the bar's own: what is as large as the limit stands below it.
    double inside = std::max(1.0, static_cast<double>(size.unknowns) - 0.5);
    auto bin = std::min(static_cast<std::size_t>(std::log2(inside)), bars.size() - 1);
    bars[bin].count += 1.0;
  }
  return bars;
}

constexpr int foldedHeight = 260;  // of cards below each other: a map that can be read

class ClusterStage : public QWidget {
 public:
  explicit ClusterStage(ClusterPage& model) : model_(model) {
    auto* rows = new FoldingRows(this);
    rows->setFoldedHeight(foldedHeight);
    auto* mapCard = new Card(ClusterPage::tr("Cluster map"));
    mapCard->setSubtitle(ClusterPage::tr("click a pixel"));
    errorCard_ = new Card(ClusterPage::tr("Error map"));
    map_ = new MapView;
    error_ = new MapView;
    map_->setObjectName("cluster-view");
    error_->setObjectName("error-view");
    map_->setScaleBar(true);
    map_->keepRoomForBar();
    map_->setLink(&link_);
    error_->setLink(&link_);
    for (MapView* view : {map_, error_}) {
      view->setEmptyText(ClusterPage::tr("Grouping"));
      view->setReadout([this](QPoint pixel) { return readout(pixel); });
    }
    connect(&link_, &ViewLink::picked, this, [this] { outline(); });
    form_ = new Segmented({ClusterPage::tr("Flat"), ClusterPage::tr("Relief")});
    form_->setObjectName("form");
    connect(form_, &Segmented::chosen, error_, [this](int index) { error_->setRelief(index == 1); });
    errorCard_->addAction(form_);
    // One choice for both: beside each other there is no room for a second.
    mapCard->addAction(new DeviceSelector(DeviceSelector::Kind::camera, model, mapCard));
    auto fail = [&model](const Failure& failure) {
      Q_EMIT model.failed({failure, ClusterPage::tr("What is measured is safe.")});
    };
    addViewActions(*mapCard, *map_, {{}, {}}, fail);
    addViewActions(*errorCard_, *error_, {[view = error_] { return view->values(); }, "relative RMS error"},
                   fail);
    mapCard->body()->addWidget(map_, 1);
    errorCard_->body()->addWidget(error_, 1);
    rows->addRow({mapCard, errorCard_}, 5);
    sizeCard_ = new Card(ClusterPage::tr("Cluster sizes"));
    sizes_ = new CutHistogram(
        {1.0, 1024.0, true, ClusterPage::tr("Projector pixels in the cluster").toStdString()},
        ClusterPage::tr("Clusters"));
    sizes_->setMovable(false);
    sizes_->setFocusPolicy(Qt::NoFocus);
    sizeCard_->body()->addWidget(sizes_, 1);
    rows->addRow({sizeCard_}, 3);
    connect(&model_.session(), &Session::opened, &link_, &ViewLink::reset);
    refreshOn(
        model_, this, [this] { refresh(); }, &ClusterPage::settingsChanged, &ClusterPage::resultChanged);
  }

 private:
  QString readout(QPoint pixel) const {
    const auto& result = model_.result();
    if (!result) return {};
    std::size_t at = indexOf(result->camera, {pixel.x(), pixel.y()});
    if (result->map[at] == clustering::noCluster)
      return ClusterPage::tr("%1, %2: in no cluster").arg(pixel.x()).arg(pixel.y());
    const auto unknowns = static_cast<int>(result->sizes[result->map[at]].unknowns);
    if (!result->exact)
      return ClusterPage::tr("%1, %2: %n projector pixel(s)", nullptr, unknowns)
          .arg(pixel.x())
          .arg(pixel.y());
    return ClusterPage::tr("%1, %2: %n projector pixel(s), error %3", nullptr, unknowns)
        .arg(pixel.x())
        .arg(pixel.y())
        .arg(percentText(static_cast<double>(result->error[at])));
  }
  void refresh() {
    const auto& result = model_.result();
    if (result == shown_) return;
    shown_ = result;
    if (!result) {
      map_->setPicture({});
      error_->setValues({});
      error_->setBadge({});
      outline();
      sizes_->setBars({});
      sizeCard_->setSubtitle({});
      return error_->setPicture({});
    }
    map_->setPicture(result->picture);
    const auto clusters = static_cast<int>(result->sizes.size());
    map_->setAccessibleName(
        groupedText(ClusterPage::tr("Cluster map, %n cluster(s), largest %1", nullptr, clusters), clusters)
            .arg(result->statistics.largest));
    showErrors();
    outline();
    sizes_->setBars(barsOf(result->sizes));
    sizes_->setCut(model_.settings().mostUnknowns);
    sizes_->setCutText(ClusterPage::tr("limit %1").arg(model_.settings().mostUnknowns));
    sizeCard_->setSubtitle(model_.sizesText());
  }

  /// What is known of the map before stays, and says so.
  void showErrors() {
    bool any = !shown_->errorPicture.isNull();
    error_->setBadge(any && !shown_->exact ? ClusterPage::tr("Grouping again") : QString());
    if (!shown_->exact && any) return;
    if (!any) {
      error_->setValues({});
      return error_->setPicture({});
    }
    error_->setScale(shown_->errorScale, ClusterPage::tr("error"), true);
    error_->setPicture(shown_->errorPicture);
    error_->setValues(image::Image(shown_->camera, 1, shown_->error));
    setPossible(form_, error_->canRise(), ClusterPage::tr("Reliefs need OpenGL, which is not there."));
    QString median = percentText(shown_->statistics.errorMedian);
    error_->setAccessibleName(ClusterPage::tr("Error map, median %1").arg(median));
  }

  /// Of the picked pixel's cluster, in both maps.
  void outline() {
    QImage line;
    if (shown_ && link_.pick()) {
      std::size_t at = indexOf(shown_->camera, {link_.pick()->x(), link_.pick()->y()});
      if (at < shown_->map.size() && shown_->map[at] != clustering::noCluster)
        line = clusterOutline(shown_->map, shown_->camera, shown_->map[at]);
    }
    map_->setOverlay(line);
    error_->setOverlay(line);
  }

  ClusterPage& model_;
  ViewLink link_;
  MapView *map_, *error_;
  Card *errorCard_, *sizeCard_;
  Segmented* form_;
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

/// Faster than any screen is fast enough.
QString framesText(const engine::FrameCost& cost) {
  constexpr double most = 240.0;
  const double frames = 1.0 / cost.seconds;
  if (frames > most) return ClusterPage::tr("over %1").arg(static_cast<int>(most));
  return ClusterPage::tr("about %1")
      .arg(frames < 10.0 ? decimalText(frames, 1) : countText(static_cast<std::uint64_t>(frames)));
}

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
  auto* cut = new ValueRow(ClusterPage::tr("Cut off by the size limit"));
  auto* kept = new ValueRow(ClusterPage::tr("Light kept in clusters"));
  auto* error = new ValueRow(ClusterPage::tr("Median error"));
  auto* most = new ValueRow(ClusterPage::tr("95 % of pixels below"));
  auto* films = new ValueRow(ClusterPage::tr("Films, frames a second"));
  films->setObjectName("frame-rate");
  films->setToolTip(ClusterPage::tr(
      "What this computer manages in Full HD with the light that Threshold keeps. The groups make no "
      "difference to it: films are solved in overlapping windows."));
  for (ValueRow* row : {clusters, cut, kept, error, most, films}) column->addWidget(row);
  column->addWidget(labelOf(
      ClusterPage::tr("Films are shown by “All bounces, for films”, whatever the clusters are. Clusters tell "
                      "which places light each other, and can be compared at Preview."),
      "note"));
  auto* normal = new Note(Note::Kind::information);
  normal->setObjectName("normal-error");
  column->addWidget(normal);
  auto* percolated = new Note(Note::Kind::amber);
  column->addWidget(percolated);
  column->addStretch(1);

  auto change = [&model](const QString& what, auto apply) {
    clustering::ClusteringSettings settings = model.settings();
    apply(settings);
    model.setSettings(settings, what);
  };
  QObject::connect(distance->slider, &QSlider::valueChanged, &model, [change](int value) {
    change(ClusterPage::tr("Distance"),
           [value](clustering::ClusteringSettings& s) { s.patchRadius = value; });
  });
  QObject::connect(share->slider, &QSlider::valueChanged, &model, [change](int value) {
    change(ClusterPage::tr("Share of the brightest"),
           [value](clustering::ClusteringSettings& s) { s.patchCut = value / 100.0; });
  });
  QObject::connect(largest->slider, &QSlider::valueChanged, &model, [change](int value) {
    change(ClusterPage::tr("Largest cluster"),
           [value](clustering::ClusteringSettings& s) { s.mostUnknowns = 16 * value; });
  });
  auto refresh = [=, &model] {
    const clustering::ClusteringSettings& settings = model.settings();
    distance->set(static_cast<int>(settings.patchRadius), ClusterPage::tr("%1 px").arg(settings.patchRadius));
    share->set(static_cast<int>(std::lround(100.0 * settings.patchCut)), percentText(settings.patchCut));
    largest->set(settings.mostUnknowns / 16, ClusterPage::tr("%1 px").arg(settings.mostUnknowns));
    films->setValue(model.frameCost() ? framesText(*model.frameCost()) : QString::fromUtf8("–"));
    const auto& result = model.result();
    percolated->setVisible(false);
    normal->setVisible(false);
    if (!result) return;
    const clustering::ClusteringStatistics& s = result->statistics;
    // Of nothing there are no shares.
    const bool isNone = result->sizes.empty();
    const auto shown = [isNone](const QString& value) { return isNone ? QString::fromUtf8("–") : value; };
    normal->setVisible(result->exact && !isNone && isUsualError(s));
    normal->setText(ClusterPage::tr("An error of %1 is normal here.").arg(percentText(s.errorMedian)),
                    ClusterPage::tr("Grouping drops the blur of the lens on purpose: little where it is "
                                    "sharp, 70 to 80 % where it is "
                                    "blurred. Look for patches that stand out from their surroundings."));
    clusters->setValue(countText(result->sizes.size()));
    cut->setValue(shown(ClusterPage::tr("%1 of light").arg(percentText(s.cutByCap))));
    kept->setValue(shown(percentText(s.keptLight)));
    // Of the map before, until its own are known.
    const char* style = result->exact ? "strong" : "note";
    error->setValue(result->error.empty() ? QString() : shown(percentText(s.errorMedian)), style);
    most->setValue(result->error.empty() ? QString() : shown(percentText(s.errorP95)), style);
    double joined =
        s.litProjectorPixels > 0 ? s.largestBeforeCap / static_cast<double>(s.litProjectorPixels) : 0.0;
    percolated->setVisible(joined > 0.2);
    percolated->setText(
        ClusterPage::tr("Without a size limit, one cluster would cover %1 of the picture.")
            .arg(percentText(joined)),
        ClusterPage::tr(
            "The surface is blurred across neighbouring pixels, so groups join up. The limit keeps "
            "them apart."));
  };
  refreshOn(model, card, refresh, &ClusterPage::settingsChanged, &ClusterPage::resultChanged);
  return card;
}

}  // namespace

PageView viewOf(ClusterPage& model) {
  return {new ClusterStage(model), inspectorOf(model)};
}

}  // namespace relucent::gui
