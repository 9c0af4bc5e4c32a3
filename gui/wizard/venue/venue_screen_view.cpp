// SPDX-License-Identifier: MIT
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"
#include "wizard/venue/screen_list.h"
#include "wizard/venue/venue_page.h"
#include "wizard/venue/venue_parts.h"

namespace relucent::gui {
namespace {

/// Screens for the calibration that is open, its own chosen whenever the page turns to them.
class OpenScreenList : public ScreenList {
 public:
  explicit OpenScreenList(VenuePage& model)
      : ScreenList([&model](const ScreenChoice& choice) { model.openScreen().choose(choice); },
                   [&model] { return model.openScreen().choices(); }),
        model_(model) {}

 protected:
  void showEvent(QShowEvent* event) override {
    if (const pipeline::ScreenRigSettings* screen = model_.session().screenRig()) start(screen->display);
    ScreenList::showEvent(event);
  }

 private:
  VenuePage& model_;
};

}  // namespace

void pointOutScreens(VenuePage& model, QWidget* list) {
  QObject::connect(&model, &VenuePage::remedyWanted, list, [&model, list] {
    if (model.remedy() == VenuePage::Remedy::screen) pointOut(list);
  });
}

QWidget* screenStage(VenuePage& model) {
  auto* stage = new QWidget;
  auto* column = new QVBoxLayout(stage);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(space::gap);
  auto* list = new OpenScreenList(model);
  column->addWidget(screensCard(stage, list), 1);
  pointOutScreens(model, list);
  auto* note = new Note(Note::Kind::amber);
  note->setObjectName("moved-screen");
  column->addWidget(note);
  auto refresh = [&model, note] {
    const QString meaning = model.openScreen().meaning();
    note->setVisible(!meaning.isEmpty());
    note->setText(VenuePage::tr("Nothing is measured again"), meaning);
  };
  refreshOn(model, note, refresh, &VenuePage::settingsChanged);
  return stage;
}

QWidget* screenInspector(VenuePage& model) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(labelOf(VenuePage::tr("This venue"), "section"));
  auto* measured = new ValueRow(VenuePage::tr("Measured at"));
  auto* used = new ValueRow(VenuePage::tr("Used at"));
  auto* pixels = new ValueRow(VenuePage::tr("Pixels"));
  for (ValueRow* row : {measured, used, pixels}) column->addWidget(row);
  column->addWidget(labelOf(VenuePage::tr("A screen is known again by its maker's names and serial number. "
                                          "Where it tells none, it is known by its connector: then a cable "
                                          "that is plugged in elsewhere has to be said here."),
                            "note"));
  column->addStretch(1);
  auto refresh = [&model, measured, used, pixels] {
    const pipeline::ScreenRigSettings* screen = model.session().screenRig();
    if (screen == nullptr) return;
    measured->setVisible(model.session().isMeasured());
    measured->setValue(QString::fromStdString(model.session().measuredDisplay().connector));
    used->setValue(QString::fromStdString(screen->display.connector));
    pixels->setValue(sizeText(screen->projector.width, screen->projector.height));
  };
  refreshOn(model, card, refresh, &VenuePage::settingsChanged);
  return card;
}

}  // namespace relucent::gui
