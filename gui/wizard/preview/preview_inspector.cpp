// SPDX-License-Identifier: MIT
#include "wizard/preview/preview_inspector.h"

#include <QFileDialog>
#include <QSlider>
#include <algorithm>
#include <cmath>

#include "theme/controls.h"
#include "theme/theme.h"
#include "theme/tick.h"
#include "views/number_text.h"
#include "wizard/devices/perfecting_part.h"
#include "wizard/frame/page_view.h"
#include "wizard/preview/preview_page.h"
#include "wizard/preview/views_part.h"

namespace relucent::gui {
namespace {

/// Acquire and this page speak of different pictures; empty: one of the two is not known.
QString expectationText(const PreviewPage& page) {
  const std::optional<MethodPreview> chosen = page.chosenRow();
  const std::optional<double> expected = page.expectedOfOthers();
  if (!chosen || !expected) return {};
  const auto decibels = [](double value) {
    return isolated(PreviewPage::tr("%1 dB").arg(decimalText(value, 1)));
  };
  return PreviewPage::tr(
             "This content comes to %1. Acquire expected %2 on average of three other pictures, by the "
             "recommended method.")
      .arg(decibels(chosen->psnr), decibels(*expected));
}

struct BrightnessText {
  compensation::Brightness value;
  QString name, sentence;
};

/// In the order of the buttons.
std::array<BrightnessText, 3> brightnessTexts() {
  using compensation::Brightness;
  return {{{Brightness::even, PreviewPage::tr("Even"),
            PreviewPage::tr("One white for all pictures, as bright as most of the surface can show it.")},
           {Brightness::picture, PreviewPage::tr("By picture"),
            PreviewPage::tr("Each picture has the white at which the least of it is lost: dark ones become "
                            "brighter, bright ones dimmer.")},
           {Brightness::region, PreviewPage::tr("By region"),
            PreviewPage::tr("The same for each part of the picture, smoothly from one to the next: the least "
                            "is lost of all.")}}};
}

}  // namespace

QWidget* previewInspector(PreviewPage& page) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(labelOf(PreviewPage::tr("Content"), "section"));
  auto* row = new QHBoxLayout;
  row->addWidget(new IconLabel(Icon::picture, secondaryColour, 22));
  QLabel* name = labelOf({}, "strong");
  row->addWidget(name, 1);
  QPushButton* change = buttonOf(PreviewPage::tr("Change"));
  row->addWidget(change);
  column->addLayout(row);
  auto* fit = new Segmented({PreviewPage::tr("Whole"), PreviewPage::tr("Fill"), PreviewPage::tr("Stretch")});
  fit->setObjectName("fit");
  column->addWidget(fit);
  QPushButton* automatic = buttonOf(PreviewPage::tr("Place automatically"));
  automatic->setObjectName("place-automatically");
  automatic->setToolTip(PreviewPage::tr("In the largest upright rectangle that can be reached"));
  column->addWidget(automatic);
  auto* problem = new Note(Note::Kind::amber);
  problem->setObjectName("place-problem");
  column->addWidget(problem);
  column->addWidget(lineOf());
  column->addWidget(viewsPart(page));
  column->addWidget(labelOf(PreviewPage::tr("Light"), "section"));
  const std::array whites = brightnessTexts();
  auto* white = new Segmented({whites[0].name, whites[1].name, whites[2].name});
  white->setObjectName("white");
  white->setAccessibleName(PreviewPage::tr("How bright white is"));
  column->addWidget(white);
  QLabel* whiteSentence = labelOf({}, "note");
  whiteSentence->setObjectName("white-sentence");
  column->addWidget(whiteSentence);
  auto* bright = new ValueRow(PreviewPage::tr("May stay too dark"));
  auto* brightness = new QSlider(Qt::Horizontal);
  brightness->setRange(0, 60);
  brightness->setObjectName("brightness");
  brightness->setAccessibleName(PreviewPage::tr("Share of the content that may stay too dark, percent"));
  column->addWidget(bright);
  column->addWidget(brightness);
  column->addWidget(labelOf(
      PreviewPage::tr("The larger this share, the brighter the picture, and the more of it stays too dark."),
      "note"));
  auto* black = new ValueRow(PreviewPage::tr("Lift of the blacks"));
  auto* lift = new QSlider(Qt::Horizontal);
  lift->setRange(0, 20);
  lift->setAccessibleName(PreviewPage::tr("Lift of the blacks, percent"));
  auto* least = new Tick(PreviewPage::tr("As little as hides where projectors end"));
  least->setObjectName("least-lift");
  column->addWidget(black);
  column->addWidget(lift);
  column->addWidget(least);
  column->addWidget(lineOf());
  column->addWidget(labelOf(PreviewPage::tr("Reach"), "section"));
  auto* reach = new ValueRow(PreviewPage::tr("Can be reached"));
  auto* dark = new ValueRow(PreviewPage::tr("Too dark to reach"));
  auto* never = new ValueRow(PreviewPage::tr("Never black enough"));
  auto* error = new ValueRow(PreviewPage::tr("Colour error"));
  for (ValueRow* value : {reach, dark, never, error}) column->addWidget(value);
  QLabel* others = labelOf({}, "note");
  others->setObjectName("expected-of-others");
  column->addWidget(others);
  auto* shadow = new Note(Note::Kind::information);
  column->addWidget(shadow);
  column->addWidget(lineOf());
  column->addWidget(perfectingPart(page, page.perfecting(),
                                   {[&page] { return page.mayPerfect(); }, [&page] { page.perfect(); }}));
  column->addStretch(1);

  QObject::connect(change, &QPushButton::clicked, &page, [&page, card] {
    QString file =
        QFileDialog::getOpenFileName(card, PreviewPage::tr("Choose a picture"), {},
                                     PreviewPage::tr("Pictures (*.png *.jpg *.jpeg *.tif *.tiff *.exr)"));
    if (!file.isEmpty()) page.choosePicture(file);
  });
  QObject::connect(automatic, &QPushButton::clicked, &page, &PreviewPage::placeAutomatically);
  auto apply = [&page](const QString& what, auto edit) {
    pipeline::ContentSettings settings = page.settings();
    edit(settings);
    page.setSettings(settings, what);
  };
  static constexpr std::array fits{compensation::Fit::fit, compensation::Fit::cover, compensation::Fit::fill};
  QObject::connect(fit, &Segmented::chosen, &page, [apply](int index) {
    apply(PreviewPage::tr("Fit"),
          [index](pipeline::ContentSettings& s) { s.fit = fits[static_cast<std::size_t>(index)]; });
  });
  QObject::connect(white, &Segmented::chosen, &page, [apply, whites](int index) {
    apply(PreviewPage::tr("Brightness"), [&](pipeline::ContentSettings& s) {
      s.brightness = whites[static_cast<std::size_t>(index)].value;
    });
  });
  QObject::connect(brightness, &QSlider::valueChanged, &page, [apply](int value) {
    apply(PreviewPage::tr("Brightness"),
          [value](pipeline::ContentSettings& s) { s.reachablePercentile = value; });
  });
  QObject::connect(lift, &QSlider::valueChanged, &page, [apply](int value) {
    apply(PreviewPage::tr("Lift of the blacks"),
          [value](pipeline::ContentSettings& s) { s.blackLift = value / 100.0; });
  });
  QObject::connect(least, &Tick::toggled, &page, [apply, &page](bool isLeast) {
    apply(PreviewPage::tr("Lift of the blacks"), [isLeast, &page](pipeline::ContentSettings& s) {
      s.blackLift.reset();
      if (!isLeast) s.blackLift = page.preview() ? page.preview()->blackLift : 0.0;
    });
  });
  auto refresh = [=, &page] {
    const pipeline::ContentSettings& settings = page.settings();
    name->setText(page.pictureName());
    fit->setCurrent(static_cast<int>(std::find(fits.begin(), fits.end(), settings.fit) - fits.begin()));
    const auto chosen = std::ranges::find(whites, settings.brightness, &BrightnessText::value);
    white->setCurrent(static_cast<int>(chosen - whites.begin()));
    whiteSentence->setText(chosen->sentence);
    white->setAccessibleDescription(chosen->sentence);
    QSignalBlocker quietBrightness(brightness), quietLift(lift), quietLeast(least);
    brightness->setValue(static_cast<int>(settings.reachablePercentile));
    // Of one projector there is nothing to hide.
    const bool isLeast = !settings.blackLift && page.projectors() > 1;
    const double found = page.preview() ? page.preview()->blackLift : 0.0;
    const double blackLift = settings.blackLift.value_or(isLeast ? found : 0.0);
    least->setVisible(page.projectors() > 1);
    least->setChecked(isLeast);
    lift->setEnabled(!isLeast);
    lift->setValue(static_cast<int>(std::lround(100.0 * blackLift)));
    bright->setValue(percentText(settings.reachablePercentile / 100.0));
    black->setValue(percentText(blackLift));
    automatic->setEnabled(page.isPlacedByHand());
    problem->setVisible(!page.problem().isEmpty());
    problem->setText(page.problem());
    constexpr double worthSaying = 0.01;
    shadow->setVisible(page.preview() && page.preview()->unlit > worthSaying);
    if (page.projectors() == 1)
      shadow->setText(PreviewPage::tr("Part of the picture gets no light from this projector."),
                      PreviewPage::tr("A second could fill it."));
    else
      shadow->setText(PreviewPage::tr("Part of the picture gets no light from any projector."),
                      PreviewPage::tr("Another one could fill it."));
    const QString expected = expectationText(page);
    others->setText(expected);
    others->setVisible(!expected.isEmpty());
    if (const auto& preview = page.preview()) {
      const ViewPreview& view = preview->views[std::min(page.camera(), preview->views.size() - 1)];
      reach->setValue(percentText(view.reachableShare), view.reachableShare > 0.8 ? "good" : "amber");
      dark->setValue(percentText(preview->tooDark));
      never->setValue(percentText(preview->tooBright));
      error->setValue(isolated(QString::fromUtf8("ΔE %1").arg(decimalText(view.deltaEMean, 1))));
    }
  };
  refreshOn(page, card, refresh, &PreviewPage::settingsChanged, &PreviewPage::resultChanged);
  return card;
}

}  // namespace relucent::gui
