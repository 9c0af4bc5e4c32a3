// SPDX-License-Identifier: MIT
#include "wizard/threshold/threshold_view.h"

#include <QKeyEvent>
#include <QLineEdit>
#include <QLocale>
#include <QSlider>
#include <algorithm>
#include <cmath>
#include <limits>

#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/folding_rows.h"
#include "theme/theme.h"
#include "views/cut_histogram.h"
#include "views/number_text.h"
#include "views/raster_axis.h"
#include "wizard/threshold/threshold_pictures.h"

namespace relucent::gui {
namespace {

/// All that was measured, and of it what stays: the same that the readouts say.
std::vector<CutHistogram::Bar> barsOf(const ThresholdPage& model) {
  std::vector<CutHistogram::Bar> bars;
  for (std::size_t bin = 0; bin < transport::StrengthHistogram::bins; ++bin) {
    bars.push_back({transport::strengthOfBin(bin), transport::strengthOfBin(bin + 1),
                    static_cast<double>(model.whole()->histogram.connections[bin])});
    if (model.kept()) bars.back().kept = static_cast<double>(model.kept()->histogram.connections[bin]);
  }
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

/// Three digits as somebody types them, without powers of ten.
QString typedText(double cut) {
  if (!(cut > 0.0)) return "0";
  const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(cut))), 0, 12);
  QLocale locale;
  locale.setNumberOptions(QLocale::OmitGroupSeparator);
  QString text = locale.toString(cut, 'f', decimals);
  while (decimals > 0 && text.endsWith(locale.zeroDigit())) text.chop(1);
  if (text.endsWith(locale.decimalPoint())) text.chop(1);
  return text;
}

/// Why that cut is suggested.
QString reasonText(const ThresholdPage& model) {
  const std::optional<ThresholdPage::NoiseCut>& noise = model.noise();
  if (!noise) return ThresholdPage::tr("Suggested: keeps nearly all of the light.");
  if (model.isNoiseSuggested())
    return ThresholdPage::tr("Suggested: three times the noise of the measurement.");
  return ThresholdPage::tr(
             "At three times the noise, %1, only %2 of the light would stay: much faint light adds up. "
             "Suggested: keep everything.")
      .arg(numberText(noise->cut), percentText(noise->keeps));
}

QWidget* stageOf(ThresholdPage& model) {
  auto* stage = new QWidget;
  auto* rows = new FoldingRows(stage);
  constexpr int leastPicture = 250,
                leastHistogram = 190;  // of their cards; where that is too much, it scrolls
  QWidget *device = deviceCard(model), *matrix = matrixCard(model);
  for (QWidget* picture : {device, matrix}) picture->setMinimumHeight(leastPicture);
  rows->addRow({device, matrix}, 5);
  auto* card = new Card(ThresholdPage::tr("How much light flows through each connection"));
  card->setSubtitle(ThresholdPage::tr("drag the cut, or use the arrow keys"));
  auto* histogram = new CutHistogram({1e-6, 1.0, true, {}}, ThresholdPage::tr("Connections"));
  histogram->setObjectName("cut-histogram");
  histogram->setAccessibleName(ThresholdPage::tr("Cut"));
  card->body()->addWidget(histogram, 1);
  card->setMinimumHeight(leastHistogram);
  rows->addRow({card}, 4);
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
    histogram->setBars(barsOf(model));
    double cut = static_cast<double>(model.cut().absolute);
    histogram->setCut(model.isShareOfPixel() ? std::numeric_limits<double>::quiet_NaN()
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
  auto* kind = new Segmented({ThresholdPage::tr("One value"), ThresholdPage::tr("Share of each pixel")});
  column->addWidget(kind);
  auto* share = new QSlider(Qt::Horizontal);
  share->setRange(0, 100);
  share->setAccessibleName(
      ThresholdPage::tr("Share of the strongest light of each camera pixel, in tenths of a percent"));
  auto* shareText = labelOf({}, "note");
  column->addWidget(share);
  column->addWidget(shareText);
  auto* typed = new QLineEdit;
  typed->setObjectName("cut-value");
  typed->setAccessibleName(ThresholdPage::tr("Cut, camera signal a second"));
  auto* usePicked = new ActionButton(ThresholdPage::tr("Use picked pixel"));
  usePicked->setObjectName("use-picked");
  // Rows of their own: the button's words are long in some languages, the number must not be cut.
  column->addWidget(typed);
  QLabel* refused = labelOf({}, "amber");
  refused->setObjectName("cut-refused");
  column->addWidget(refused);
  leaveUndoToThePage(typed, typed);
  column->addWidget(usePicked);
  auto* suggest = new ActionButton(QString());
  suggest->setObjectName("use-suggested");
  column->addWidget(suggest);
  QLabel* why = labelOf({}, "note");
  why->setObjectName("why-suggested");
  column->addWidget(why);
  column->addWidget(lineOf());
  column->addWidget(labelOf(ThresholdPage::tr("What stays"), "section"));
  auto* light = new ValueRow(ThresholdPage::tr("Light"));
  auto* connections = new ValueRow(ThresholdPage::tr("Connections"));
  auto* each = new ValueRow(ThresholdPage::tr("For each camera pixel"));
  auto* memory = new ValueRow(ThresholdPage::tr("Memory"));
  for (ValueRow* row : {light, connections, each, memory}) column->addWidget(row);
  auto* strongestStay = labelOf(
      ThresholdPage::tr("Of each camera pixel the strongest connection always stays, however high the cut."),
      "note");
  strongestStay->setObjectName("strongest-stay");
  column->addWidget(strongestStay);
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
                   [&model](int index) { model.setShareOfPixel(index == 1); });
  QObject::connect(share, &QSlider::valueChanged, &model,
                   [&model](int value) { model.setShare(value / 1000.0); });
  QObject::connect(suggest, &QPushButton::clicked, &model, &ThresholdPage::useSuggested);
  QObject::connect(usePicked, &QPushButton::clicked, &model, &ThresholdPage::usePicked);
  // Leaving the field changes nothing.
  QObject::connect(typed, &QLineEdit::editingFinished, &model, [&model, typed, refused] {
    if (!typed->isModified()) return;
    bool isNumber = false;
    const double cut = QLocale().toDouble(typed->text(), &isNumber);
    const bool isCut = isNumber && cut >= 0.0;
    typed->setModified(false);
    refused->setProperty("typed", isCut ? QString() : typed->text());
    model.setAbsolute(isCut ? cut : static_cast<double>(model.cut().absolute));
  });
  auto refresh = [=, &model] {
    kind->setCurrent(model.isShareOfPixel() ? 1 : 0);
    share->setVisible(model.isShareOfPixel());
    shareText->setVisible(model.isShareOfPixel());
    for (QWidget* widget : std::initializer_list<QWidget*>{typed, usePicked, suggest, why})
      widget->setVisible(!model.isShareOfPixel());
    if (!typed->isModified()) {
      typed->setText(typedText(static_cast<double>(model.cut().absolute)));
      typed->setCursorPosition(0);  // where there is too little room, the first digits are seen
    }
    // The hint says it too.
    const QString reading = model.whole() ? QString() : ThresholdPage::tr("What was measured is being read.");
    setPossible(typed, reading);
    usePicked->setWhyNot(model.pickedLight() ? QString()
                         : model.pickedRow() ? ThresholdPage::tr("No light of the picked pixel was kept.")
                                             : ThresholdPage::tr("Pick a pixel in a picture."));
    why->setText(reasonText(model));
    strongestStay->setVisible(model.isStrongestKept());
    const QString wrong = refused->property("typed").toString();
    refused->setText(ThresholdPage::tr("“%1” is not a cut: type a number, 0 or more. The cut is still %2.")
                         .arg(wrong, typedText(static_cast<double>(model.cut().absolute))));
    refused->setVisible(!model.isShareOfPixel() && !wrong.isEmpty());
    QSignalBlocker quiet(share);
    share->setValue(static_cast<int>(std::lround(1000.0 * static_cast<double>(model.cut().shareOfRowMax))));
    shareText->setText(ThresholdPage::tr("Below %1 of the strongest light that each camera pixel gets")
                           .arg(percentText(static_cast<double>(model.cut().shareOfRowMax))));
    const bool isUsed = static_cast<float>(model.suggested()) == model.cut().absolute;
    suggest->setWhyNot(reading.isEmpty() && isUsed ? ThresholdPage::tr("It is in use.") : reading);
    suggest->setText(model.suggested() > 0.0
                         ? ThresholdPage::tr("Use suggested, %1").arg(numberText(model.suggested()))
                         : ThresholdPage::tr("Keep everything"));
    if (model.kept() && model.whole()) {
      const transport::TransportStatistics& kept = *model.kept();
      light->setValue(percentText(kept.energyKept), kept.energyKept < 0.95 ? "amber" : "good");
      connections->setValue(ThresholdPage::tr("%1 of %2")
                                .arg(largeText(kept.connections), largeText(model.whole()->connections)));
      const std::size_t pixels = model.acquisition()->transport.cameras().count();
      each->setValue(ThresholdPage::tr("%1 on average")
                         .arg(largeText(kept.connections / std::max<std::size_t>(1, pixels))));
      memory->setValue(bytesText(kept.bytes));
    } else {
      for (ValueRow* row : {light, connections, each, memory}) row->setValue({});
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
