// SPDX-License-Identifier: MIT
#include "wizard/session/missing_screen.h"

#include "output/window_projector.h"

namespace relucent::gui {

QString missingScreen(const Session& session) {
  for (std::size_t projector = 0; projector < session.projectors(); ++projector)
    if (const auto screen = session.screenOf(projector);
        screen && findScreen(identityOf(screen->display)) == nullptr)
      return QString::fromStdString(screen->display.connector);
  return {};
}

}  // namespace relucent::gui
