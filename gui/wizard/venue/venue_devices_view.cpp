// SPDX-License-Identifier: MIT
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/devices/flash_consent.h"
#include "wizard/frame/page_view.h"
#include "wizard/venue/screen_list.h"
#include "wizard/venue/venue_page.h"
#include "wizard/venue/venue_parts.h"

namespace relucent::gui {

QWidget* consentToBegin(VenuePage& model) {
  auto* part = new FlashConsent;
  QObject::connect(part, &FlashConsent::given, &model, &VenuePage::setRoomClear);
  auto refresh = [part, &model] { part->show(model.needsConsent(), model.isRoomClear(), std::nullopt); };
  refreshOn(model, part, refresh, &VenuePage::settingsChanged);
  QObject::connect(&model, &VenuePage::remedyWanted, part, [part, &model] {
    if (model.remedy() == VenuePage::Remedy::consent) pointOut(part->tick());
  });
  return part;
}

QWidget* devicesStage(VenuePage& model) {
  auto* stage = new QWidget;
  auto* column = new QVBoxLayout(stage);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(space::gap);
  auto* list = new ScreenList([&model](const ScreenChoice& choice) { model.chooseScreen(choice); });
  column->addWidget(screensCard(stage, list), 1);
  pointOutScreens(model, list);
  auto* note = new Note(Note::Kind::amber);
  column->addWidget(note);
  auto refresh = [&model, note] {
    const QString warning = model.screenWarning();
    note->setVisible(!warning.isEmpty());
    note->setText(VenuePage::tr("The projector shares your screen"), warning);
  };
  refreshOn(model, note, refresh, &VenuePage::settingsChanged);
  return stage;
}

QWidget* devicesInspector(VenuePage& model) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(labelOf(VenuePage::tr("Real devices"), "section"));
  auto* screen = new ValueRow(VenuePage::tr("Projector"));
  column->addWidget(screen);
  column->addWidget(labelOf(VenuePage::tr("The camera is chosen at the next step."), "note"));
  column->addWidget(lineOf());
  column->addWidget(keepingPart(model));
  column->addWidget(consentToBegin(model));
  column->addStretch(1);
  auto refresh = [&model, screen] {
    const pipeline::ScreenRigSettings& chosen = model.screen();
    screen->setValue(chosen.projector.empty()
                         ? QString::fromUtf8("–")
                         : QString("%1, %2").arg(QString::fromStdString(chosen.display.connector),
                                                 sizeText(chosen.projector.width, chosen.projector.height)));
  };
  refreshOn(model, screen, refresh, &VenuePage::settingsChanged);
  return card;
}

}  // namespace relucent::gui
