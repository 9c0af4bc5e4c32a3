// SPDX-License-Identifier: MIT
#include <QComboBox>
#include <optional>

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
        model_(model) {
    connect(&model, &VenuePage::settingsChanged, this, [this] {
      if (isVisible() && started_ && *started_ != model_.openScreen().projector()) startOfProjector();
    });
  }

 protected:
  void showEvent(QShowEvent* event) override {
    startOfProjector();
    ScreenList::showEvent(event);
  }

 private:
  void startOfProjector() {
    started_ = model_.openScreen().projector();
    if (const auto screen = model_.session().screenOf(*started_)) start(screen->display);
  }

  VenuePage& model_;
  std::optional<std::size_t> started_;
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
  auto* which = new QComboBox;
  which->setObjectName("moved-projector");
  which->setAccessibleName(VenuePage::tr("Projector whose screen is changed"));
  column->addWidget(which);
  QObject::connect(which, &QComboBox::activated, &model, [&model](int index) {
    model.openScreen().chooseProjector(static_cast<std::size_t>(index));
  });
  auto* measured = new ValueRow(VenuePage::tr("Measured at"));
  auto* used = new ValueRow(VenuePage::tr("Used at"));
  auto* pixels = new ValueRow(VenuePage::tr("Pixels"));
  for (ValueRow* row : {measured, used, pixels}) column->addWidget(row);
  column->addWidget(labelOf(VenuePage::tr("A screen is known again by its maker's names and serial number. "
                                          "Where it tells none, it is known by its connector: then a cable "
                                          "that is plugged in elsewhere has to be said here."),
                            "note"));
  column->addStretch(1);
  auto refresh = [&model, which, measured, used, pixels] {
    const std::size_t projector = model.openScreen().projector();
    const std::optional<pipeline::ScreenRigSettings> screen = model.session().screenOf(projector);
    if (!screen) return;
    const auto projectors = static_cast<int>(model.session().projectors());
    which->setVisible(projectors > 1);
    if (which->count() != projectors) {
      which->clear();
      for (int i = 0; i < projectors; ++i) which->addItem(VenuePage::tr("Projector %1").arg(i + 1));
    }
    which->setCurrentIndex(static_cast<int>(projector));
    measured->setVisible(model.session().isMeasured());
    measured->setValue(QString::fromStdString(model.session().measuredDisplay(projector).connector));
    used->setValue(QString::fromStdString(screen->display.connector));
    pixels->setValue(sizeText(screen->projector.width, screen->projector.height));
  };
  refreshOn(model, card, refresh, &VenuePage::settingsChanged);
  return card;
}

}  // namespace relucent::gui
