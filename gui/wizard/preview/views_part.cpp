// SPDX-License-Identifier: MIT
#include "wizard/preview/views_part.h"

#include <QSlider>
#include <QTimer>
#include <cmath>

#include "theme/controls.h"
#include "theme/theme.h"
#include "theme/tick.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"
#include "wizard/preview/preview_page.h"
#include "wizard/preview/viewer_plan.h"
#include "wizard/session/device_label.h"

namespace relucent::gui {
namespace {

constexpr int stepsBetweenCameras = 20;  // of the slider

/// A row for each view: its error as predicted, and how much it counts for the viewer.
class QualityRows : public QWidget {
 public:
  explicit QualityRows(PreviewPage& page) : page_(page) {
    setObjectName("view-quality");
    column_ = new QVBoxLayout(this);
    column_->setContentsMargins(0, 0, 0, 0);
    column_->setSpacing(2);
  }
  void refresh() {
    while (rows_.size() > page_.cameras()) {
      delete rows_.back();
      rows_.pop_back();
    }
    while (rows_.size() < page_.cameras()) {
      rows_.push_back(new ValueRow(cameraLabel(page_.session(), rows_.size())));
      column_->addWidget(rows_.back());
    }
    const auto& preview = page_.preview();
    const std::vector<double> shares = page_.viewerShares();
    for (std::size_t camera = 0; camera < rows_.size(); ++camera) {
      if (!preview || camera >= preview->views.size()) {
        rows_[camera]->setValue(QString::fromUtf8("–"));
        continue;
      }
      const ViewPreview& view = preview->views[camera];
      QString text = std::isnan(view.psnr)
                         ? PreviewPage::tr("no content")
                         : PreviewPage::tr("%1 dB, ΔE %2")
                               .arg(decimalText(view.psnr, 1), decimalText(view.deltaEMean, 1));
      if (camera < shares.size())
        text = PreviewPage::tr("%1, counts %2").arg(text, percentText(shares[camera]));
      rows_[camera]->setValue(isolated(text), camera == page_.camera() ? "good" : "strong");
    }
  }

 private:
  PreviewPage& page_;
  QVBoxLayout* column_;
  std::vector<ValueRow*> rows_;
};

}  // namespace

QWidget* viewsPart(PreviewPage& page) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(PreviewPage::tr("Views"), "section"));
  auto* quality = new QualityRows(page);
  column->addWidget(quality);
  auto* contradicting = new ValueRow(PreviewPage::tr("Visibly worse because of other views"));
  contradicting->setObjectName("contradiction");
  column->addWidget(contradicting);
  auto* placement = new Segmented({PreviewPage::tr("On the surface"), PreviewPage::tr("Upright from here")});
  placement->setObjectName("view-placement");
  column->addWidget(placement);
  auto* weightRow = new ValueRow(PreviewPage::tr("Weight of this view"));
  auto* weight = new QSlider(Qt::Horizontal);
  weight->setObjectName("view-weight");
  weight->setRange(0, 100);
  weight->setAccessibleName(PreviewPage::tr("Weight of the shown view, percent"));
  column->addWidget(weightRow);
  column->addWidget(weight);
  auto* one = new Tick(PreviewPage::tr("For one viewer who moves"));
  one->setObjectName("one-viewer");
  column->addWidget(one);
  auto* walk = new QSlider(Qt::Horizontal);
  walk->setObjectName("viewer-walk");
  walk->setAccessibleName(PreviewPage::tr("Where the viewer stands, from the first camera to the last"));
  auto* plan = new ViewerPlan;
  QLabel* place = labelOf({}, "note");
  place->setObjectName("viewer-place");
  for (QWidget* widget : std::initializer_list<QWidget*>{walk, plan, place}) column->addWidget(widget);
  column->addWidget(lineOf());

  QObject::connect(placement, &Segmented::chosen, &page, [&page](int index) {
    compensation::ViewSettings view = page.view(page.camera());
    view.placement = index == 1 ? compensation::ViewPlacement::own : compensation::ViewPlacement::surface;
    page.setView(page.camera(), view, PreviewPage::tr("Place in this view"));
  });
  QObject::connect(weight, &QSlider::valueChanged, &page, [&page](int percent) {
    compensation::ViewSettings view = page.view(page.camera());
    view.weight = percent / 100.0;
    page.setView(page.camera(), view, PreviewPage::tr("Weight of a view"));
  });
  QObject::connect(one, &Tick::toggled, &page, [&page, one, plan, place](bool wanted) {
    if (!wanted) return page.setViewer(std::nullopt);
    if (!page.viewer()) page.setViewerOnPath(0.5 * static_cast<double>(page.cameras() - 1));
    // In a low window the plan is below what can be seen. Once all have their places, the last one above all:
    QTimer::singleShot(0, plan, [one, plan, place] {
      for (QWidget* widget : std::initializer_list<QWidget*>{place, one, plan}) bringIntoSight(widget);
    });
  });
  QObject::connect(walk, &QSlider::valueChanged, &page, [&page](int value) {
    page.setViewerOnPath(static_cast<double>(value) / stepsBetweenCameras);
  });
  QObject::connect(plan, &ViewerPlan::viewerMoved, &page,
                   [&page](const compensation::Position& to) { page.setViewer(to); });
  QObject::connect(plan, &ViewerPlan::cameraMoved, &page,
                   [&page](int camera, const compensation::Position& to) {
                     page.placeCamera(static_cast<std::size_t>(camera), to);
                   });

  auto refresh = [=, &page] {
    part->setVisible(page.cameras() > 1);
    if (page.cameras() < 2) return;
    quality->refresh();
    const auto& contradiction = page.contradiction();
    contradicting->setValue(contradiction ? percentText(contradiction->share) : QString::fromUtf8("–"));
    const compensation::ViewSettings view = page.view(page.camera());
    placement->setVisible(page.camera() > 0);
    placement->setCurrent(view.placement == compensation::ViewPlacement::own ? 1 : 0);
    QSignalBlocker quietWeight(weight), quietWalk(walk), quietTick(one);
    weight->setValue(static_cast<int>(std::lround(100.0 * view.weight)));
    weightRow->setValue(percentText(view.weight));
    const bool isOne = page.viewer().has_value();
    one->setChecked(isOne);
    for (QWidget* widget : std::initializer_list<QWidget*>{walk, plan, place}) widget->setVisible(isOne);
    if (!isOne) return;
    walk->setRange(0, stepsBetweenCameras * static_cast<int>(page.cameras() - 1));
    walk->setValue(static_cast<int>(std::lround(stepsBetweenCameras * page.viewerOnPath())));
    plan->show(page.cameraPositions(), page.viewer(), page.viewerShares());
    place->setText(page.areCamerasPlaced()
                       ? plan->placeText(static_cast<int>(page.cameras()))
                       : PreviewPage::tr("Drag the cameras to where they stand, then move the viewer."));
  };
  refreshOn(page, part, refresh, &PreviewPage::settingsChanged, &PreviewPage::resultChanged);
  return part;
}

}  // namespace relucent::gui
