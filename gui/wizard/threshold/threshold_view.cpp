// SPDX-License-Identifier: MIT
#include "wizard/threshold/threshold_view.h"

#include <QSlider>
#include <cmath>
#include <limits>

#include "theme/controls.h"
#include "theme/theme.h"
#include "views/cut_histogram.h"
#include "views/number_text.h"
#include "views/raster_axis.h"
#include "wizard/threshold/threshold_pictures.h"

namespace relucent::gui {
namespace {

std::vector<CutHistogram::Bar> barsOf(const transport::StrengthHistogram& histogram) {
  std::vector<CutHistogram::Bar> bars;
  for (std::size_t bin = 0; bin < transport::StrengthHistogram::bins; ++bin)
    bars.push_back({transport::strengthOfBin(bin), transport::strengthOfBin(bin + 1),
                    static_cast<double>(histogram.leaves[bin])});
  return bars;
}

/// The decades that hold anything.
charts::Axis axisOf(const transport::StrengthHistogram& histogram) {
  std::size_t first = 0, last = transport::StrengthHistogram::bins - 1;
  while (first < last && histogram.leaves[first] == 0) ++first;
  while (last > first && histogram.leaves[last] == 0) --last;
  double low = std::pow(10.0, std::floor(std::log10(transport::strengthOfBin(first)) + 1e-9));
  double high = std::pow(10.0, std::ceil(std::log10(transport::strengthOfBin(last + 1)) - 1e-9));
  return {low, std::max(high, 10.0 * low), true};
}

QWidget* stageOf(ThresholdPage& model) {
  auto* stage = new QWidget;
  auto* column = new QVBoxLayout(stage);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(space::gap);
  auto* row = new QHBoxLayout;
  row->setSpacing(space::gap);
  row->addWidget(deviceCard(model), 10);
  row->addWidget(matrixCard(model), 11);
  column->addLayout(row, 5);
  auto* card = new Card(ThresholdPage::tr("How much light flows through each connection"));
  card->setSubtitle(ThresholdPage::tr("drag the cut, or use the arrow keys"));
  auto* histogram = new CutHistogram({1e-6, 1.0, true, {}}, ThresholdPage::tr("Connections"));
  histogram->setObjectName("cut-histogram");
  histogram->setAccessibleName(ThresholdPage::tr("Cut"));
  card->body()->addWidget(histogram, 1);
  column->addWidget(card, 4);
  QObject::connect(histogram, &CutHistogram::cutMoved, &model, &ThresholdPage::setAbsolute);
  auto refresh = [&model, histogram] {
    if (!model.whole()) {
      // Those of another measurement say nothing of this one.
      histogram->setBars({});
      return histogram->setCutText({});
    }
    charts::Axis axis = axisOf(model.whole()->histogram);
    axis.title = ThresholdPage::tr("Transport value, camera signal a second").toStdString();
    histogram->setAxis(axis);
    histogram->setBars(barsOf(model.whole()->histogram));
    double cut = static_cast<double>(model.cut().absolute);
    histogram->setCut(model.isShareOfRow() ? std::numeric_limits<double>::quiet_NaN()
                                           : std::max(cut, axis.low));
    QString kept = model.kept() ? percentText(model.kept()->energyKept) : QString();
    histogram->setCutText(cut > 0.0 ? ThresholdPage::tr("Cut at %1, keeps %2").arg(numberText(cut), kept)
                                    : ThresholdPage::tr("Everything is kept"));
  };
  refreshOn(model, histogram, refresh, &ThresholdPage::settingsChanged, &ThresholdPage::resultChanged);
  return stage;
}

QWidget* inspectorOf(ThresholdPage& model) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(labelOf(ThresholdPage::tr("Leave out light below"), "section"));
  auto* kind = new Segmented({ThresholdPage::tr("One value"), ThresholdPage::tr("Share of the row")});
  column->addWidget(kind);
  auto* share = new QSlider(Qt::Horizontal);
  share->setRange(0, 100);
  share->setAccessibleName(
      ThresholdPage::tr("Share of the row's strongest connection, in tenths of a percent"));
  auto* shareText = labelOf({}, "note");
  column->addWidget(share);
  column->addWidget(shareText);
  QPushButton* suggest = buttonOf({});
  column->addWidget(suggest);
  column->addWidget(lineOf());
  column->addWidget(labelOf(ThresholdPage::tr("What stays"), "section"));
  auto* light = new ValueRow(ThresholdPage::tr("Light"));
  auto* connections = new ValueRow(ThresholdPage::tr("Connections"));
  auto* leaves = new ValueRow(ThresholdPage::tr("Stored blocks"));
  auto* memory = new ValueRow(ThresholdPage::tr("Memory"));
  for (ValueRow* row : {light, connections, leaves, memory}) column->addWidget(row);
  column->addWidget(
      labelOf(ThresholdPage::tr("What is left out is put back in proportion, so that the surface keeps its "
                                "brightness."),
              "note"));
  column->addWidget(lineOf());
  QLabel* picked = labelOf(ThresholdPage::tr("Picked pixel"), "section");
  auto* litBy = new ValueRow(ThresholdPage::tr("Lit by"));
  auto* strongest = new ValueRow(ThresholdPage::tr("Strongest"));
  auto* direct = new ValueRow(ThresholdPage::tr("From around it"));
  auto* elsewhere = new ValueRow(ThresholdPage::tr("Light from elsewhere"));
  for (QWidget* widget : std::initializer_list<QWidget*>{picked, litBy, strongest, direct, elsewhere})
    column->addWidget(widget);
  column->addStretch(1);

  QObject::connect(kind, &Segmented::chosen, &model,
                   [&model](int index) { model.setShareOfRow(index == 1); });
  QObject::connect(share, &QSlider::valueChanged, &model,
                   [&model](int value) { model.setShare(value / 1000.0); });
  QObject::connect(suggest, &QPushButton::clicked, &model, &ThresholdPage::useSuggested);
  auto refresh = [=, &model] {
    kind->setCurrent(model.isShareOfRow() ? 1 : 0);
    share->setVisible(model.isShareOfRow());
    shareText->setVisible(model.isShareOfRow());
    suggest->setVisible(!model.isShareOfRow());
    QSignalBlocker quiet(share);
    share->setValue(static_cast<int>(std::lround(1000.0 * static_cast<double>(model.cut().shareOfRowMax))));
    shareText->setText(ThresholdPage::tr("Below %1 of the row's strongest connection")
                           .arg(percentText(static_cast<double>(model.cut().shareOfRowMax))));
    suggest->setEnabled(model.whole().has_value());
    suggest->setText(ThresholdPage::tr("Use suggested, %1").arg(numberText(model.suggested())));
    if (model.kept() && model.whole()) {
      const transport::TransportStatistics& kept = *model.kept();
      light->setValue(percentText(kept.energyKept), kept.energyKept < 0.95 ? "amber" : "good");
      connections->setValue(ThresholdPage::tr("%1 of %2")
                                .arg(numberText(static_cast<double>(kept.connections)),
                                     numberText(static_cast<double>(model.whole()->connections))));
      leaves->setValue(countText(kept.leaves));
      memory->setValue(bytesText(kept.bytes));
    } else {
      for (ValueRow* row : {light, connections, leaves, memory}) row->setValue({});
    }
    bool known = model.picked() && model.footprint();
    for (QWidget* widget : std::initializer_list<QWidget*>{picked, litBy, strongest, direct, elsewhere})
      widget->setVisible(known);
    if (!known) return;
    const transport::PixelFootprint& footprint = *model.footprint();
    picked->setText(ThresholdPage::tr("Picked pixel %1, %2").arg(model.picked()->x).arg(model.picked()->y));
    const auto pixels = static_cast<int>(footprint.pixels);
    litBy->setValue(groupedText(ThresholdPage::tr("%n pixel(s)", nullptr, pixels), pixels));
    strongest->setValue(pixelText(model.acquisition()->transport.projectors(), footprint.strongest));
    direct->setValue(percentText(footprint.nearShare));
    elsewhere->setValue(percentText(1.0 - footprint.nearShare));
  };
  refreshOn(model, card, refresh, &ThresholdPage::settingsChanged, &ThresholdPage::resultChanged);
  return card;
}

}  // namespace

PageView viewOf(ThresholdPage& model) {
  return {stageOf(model), inspectorOf(model)};
}

}  // namespace relucent::gui
