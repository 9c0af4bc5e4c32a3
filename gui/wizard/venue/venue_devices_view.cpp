// SPDX-License-Identifier: MIT
#include <memory>
#include <utility>

#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/devices/camera_rows.h"
#include "wizard/devices/flash_consent.h"
#include "wizard/frame/page_view.h"
#include "wizard/venue/device_list_view.h"
#include "wizard/venue/network_list_view.h"
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
  auto* list = new ScreenList([&model](const ScreenChoice& choice) { model.chooseScreen(choice); },
                              [&model] { return model.screensToChoose(); });
  column->addWidget(screensCard(stage, list), 1);
  auto* cameras = new CameraRows(
      model.finder(), VenuePage::tr("Add those that look at the surface."),
      [&model](const devices::ListedCamera& camera, const QString& name) {
        return model.hasCamera(camera.address)
                   ? CameraRows::Offer{VenuePage::tr("Remove"), VenuePage::tr("Remove %1").arg(name)}
                   : CameraRows::Offer{VenuePage::tr("Add"), VenuePage::tr("Add %1").arg(name)};
      },
      [&model](const devices::ListedCamera& camera) {
        if (model.hasCamera(camera.address))
          model.removeCamera(camera.address);
        else
          model.addCamera(camera.address);
      });
  cameras->setObjectName("venue-cameras");
  cameras->offerAnother(VenuePage::tr("New venue by script"),
                        [&model] { model.setMode(VenuePage::Mode::script); });
  constexpr int leastHeight = 220;  // a camera and a half: where there is less room, the stage scrolls
  cameras->setMinimumHeight(leastHeight);
  column->addWidget(cameras, 1);
  pointOutScreens(model, list);
  auto* note = new Note(Note::Kind::amber);
  column->addWidget(note);
  // What is offered depends on the projector that it is for, and on the others' screens.
  auto known = std::make_shared<std::pair<std::size_t, std::vector<std::string>>>();
  auto knownCameras = std::make_shared<std::vector<pipeline::ScreenRigSettings::Camera>>();
  auto refresh = [&model, note, list, known, cameras, knownCameras] {
    const auto screens = model.projectors();
    std::pair now(model.projector(), std::vector<std::string>());
    for (std::size_t i = 0; i < screens.size(); ++i)
      if (i != model.projector()) now.second.push_back(screens[i].display.connector);
    if (std::exchange(*known, now) != now)
      list->start(screens.empty() ? pipeline::ScreenRigSettings::Display()
                                  : screens[model.projector()].display);
    if (std::exchange(*knownCameras, model.cameras()) != model.cameras()) cameras->refresh();
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
  // First, as nothing goes on without it: below lists that grow it would be out of sight.
  column->addWidget(consentToBegin(model));
  column->addWidget(labelOf(VenuePage::tr("Real devices"), "section"));
  column->addWidget(projectorList(model));
  column->addWidget(cameraList(model));
  column->addWidget(networkList(model));
  column->addWidget(lineOf());
  column->addWidget(keepingPart(model));
  column->addStretch(1);
  return card;
}

}  // namespace relucent::gui
