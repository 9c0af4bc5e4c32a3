// SPDX-License-Identifier: MIT
#include "wizard/devices/projector_screens.h"

#include <QGuiApplication>

#include "output/window_projector.h"
#include "relucent/pipeline/screen_devices.h"
#include "wizard/session/session.h"

namespace relucent::gui {

std::vector<ScreenIdentity> projectorScreens(const Session& session) {
  std::vector<ScreenIdentity> screens;
  if (const pipeline::ScreenRigSettings* measured = session.screenRig()) {
    for (const pipeline::ScreenRigSettings::Screen& screen : pipeline::screensOf(*measured))
      if (const ScreenIdentity identity = identityOf(screen.display); findScreen(identity) != nullptr)
        screens.push_back(identity);
    return screens;
  }
  for (const QScreen* screen : QGuiApplication::screens())
    if (screen != QGuiApplication::primaryScreen() && screens.size() < session.projectors())
      screens.push_back(identityOf(*screen));
  return screens;
}

}  // namespace relucent::gui
