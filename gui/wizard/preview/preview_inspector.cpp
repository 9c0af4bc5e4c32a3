// SPDX-License-Identifier: MIT
#include "wizard/preview/preview_inspector.h"

#include <algorithm>

#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/devices/perfecting_part.h"
#include "wizard/frame/content_files.h"
#include "wizard/frame/page_view.h"
#include "wizard/preview/light_part.h"
#include "wizard/preview/mask_part.h"
#include "wizard/preview/preview_page.h"
#include "wizard/preview/set_part.h"
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

}  // namespace

QWidget* previewInspector(PreviewPage& page) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(setPart(page));
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
  auto* automatic = new ActionButton(PreviewPage::tr("Place automatically"));
  automatic->setObjectName("place-automatically");
  automatic->setToolTip(PreviewPage::tr("In the largest upright rectangle that can be reached"));
  column->addWidget(automatic);
  auto* problem = new Note(Note::Kind::amber);
  problem->setObjectName("place-problem");
  column->addWidget(problem);
  column->addWidget(lineOf());
  column->addWidget(viewsPart(page));
  column->addWidget(lightPart(page));
  column->addWidget(lineOf());
  column->addWidget(maskPart(page));
  column->addWidget(labelOf(PreviewPage::tr("Reach"), "section"));
  auto* reach = new ValueRow(PreviewPage::tr("Can be reached"));
  auto* dark = new ValueRow(PreviewPage::tr("Too dark to reach"));
  auto* never = new ValueRow(PreviewPage::tr("Never black enough"));
  auto* error = new ValueRow(PreviewPage::tr("Colour error"));
  auto* uncertain = new ValueRow(PreviewPage::tr("Uncertainty"));
  uncertain->setObjectName("uncertainty");
  uncertain->setToolTip(
      PreviewPage::tr("95 of 100 pixels come within this of what is predicted, in percent of white. More "
                      "photographs or longer exposures make it smaller."));
  for (ValueRow* value : {reach, dark, never, error, uncertain}) column->addWidget(value);
  QLabel* others = labelOf({}, "note");
  others->setObjectName("expected-of-others");
  column->addWidget(others);
  auto* shadow = new Note(Note::Kind::information);
  column->addWidget(shadow);
  column->addWidget(lineOf());
  column->addWidget(perfectingPart(page, page.perfecting(),
                                   {[&page] { return page.whyNotPerfect(); }, [&page] { page.perfect(); }}));
  column->addStretch(1);

  QObject::connect(change, &QPushButton::clicked, &page, [&page, card] {
    const QString file = askForFile(card, PreviewPage::tr("Choose a picture"), ContentFiles::pictures);
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
  auto refresh = [=, &page] {
    const pipeline::ContentSettings& settings = page.settings();
    name->setText(page.pictureName());
    fit->setCurrent(static_cast<int>(std::find(fits.begin(), fits.end(), settings.fit) - fits.begin()));
    automatic->setWhyNot(page.isPlacedByHand() ? QString() : PreviewPage::tr("It is placed automatically."));
    problem->setVisible(!page.problem().isEmpty());
    problem->setText(page.problem());
    constexpr double worthSaying = 0.01;
    shadow->setVisible(page.preview() && page.preview()->unlit > worthSaying);
    if (page.isMuchLeftOut())
      shadow->setText(PreviewPage::tr("Part of the picture lies where the view is left out."),
                      PreviewPage::tr("It stays uncorrected. Acquire says why."));
    else if (page.projectors() == 1)
      shadow->setText(PreviewPage::tr("Part of the picture gets no light from this projector."),
                      PreviewPage::tr("A second could fill it."));
    else
      shadow->setText(PreviewPage::tr("Part of the picture gets no light from any projector."),
                      PreviewPage::tr("Another one could fill it."));
    const QString expected = expectationText(page);
    others->setText(expected);
    others->setVisible(!expected.isEmpty());
    uncertain->setVisible(page.preview() && !page.preview()->first().uncertainty.empty());
    if (const auto& preview = page.preview()) {
      const ViewPreview& view = preview->views[std::min(page.camera(), preview->views.size() - 1)];
      reach->setValue(percentText(view.reachableShare), view.reachableShare > 0.8 ? "good" : "amber");
      dark->setValue(percentText(preview->tooDark));
      never->setValue(percentText(preview->tooBright));
      error->setValue(isolated(QString::fromUtf8("ΔE %1").arg(decimalText(view.deltaEMean, 1))));
      uncertain->setValue(marginText(view.uncertaintyMean));
    }
  };
  refreshOn(page, card, refresh, &PreviewPage::settingsChanged, &PreviewPage::resultChanged);
  return card;
}

}  // namespace relucent::gui
