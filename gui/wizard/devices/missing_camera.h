// SPDX-License-Identifier: MIT
#pragma once

#include <QCoreApplication>

#include "wizard/frame/page_model.h"

namespace relucent::gui {

/// What stands above a page while its photograph does not come. The camera is connected again by itself
/// (core/devices/driven_camera.h); if that fails, a dialog says so.
inline Banner missingCamera() {
  return {Banner::Kind::amber, QCoreApplication::translate("MissingCamera", "The camera does not answer"),
          QCoreApplication::translate(
              "MissingCamera",
              "Everything so far is safe. Push in its cable at both ends, and do not move "
              "the tripod: it goes on by itself.")};
}
/// The same in the rail.
inline QString missingCameraText() {
  return QCoreApplication::translate("MissingCamera", "Camera silent");
}

}  // namespace relucent::gui
