// SPDX-License-Identifier: MIT
#include "wizard/devices/projector_screens.h"

#include <QGuiApplication>

#include "output/window_projector.h"
#include "wizard/session/session.h"

namespace relucent::gui {

std::vector<ScreenIdentity> projectorScreens(const Session& session) {
  std::vector<ScreenIdentity> screens;
  if (const pipeline::ScreenRigSettings* measured = session.screenRig()) {
    const ScreenIdentity identity = identityOf(measured->display);
    if (findScreen(identity) != nullptr) screens.push_back(identity);
    return screens;
  }
  for (const QScreen* screen : QGuiApplication::screens())
    if (screen != QGuiApplication::primaryScreen() && screens.size() < session.projectors())
      screens.push_back(identityOf(*screen));
  return screens;
}

}  // namespace relucent::gui
