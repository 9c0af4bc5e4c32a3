// SPDX-License-Identifier: MIT
#include "wizard/camera/camera_choice_view.h"

#include "wizard/camera/camera_page.h"
#include "wizard/devices/camera_rows.h"

namespace relucent::gui {

QWidget* cameraChoice(CameraPage& model) {
  const auto offering = [](const devices::ListedCamera&, const QString& name) {
    return CameraRows::Offer{CameraPage::tr("Choose"), CameraPage::tr("Choose %1").arg(name)};
  };
  return new CameraRows(
      model.finder(), CameraPage::tr("Choose the one that looks at the surface."), offering,
      [&model](const devices::ListedCamera& camera) { model.chooseCamera(camera.address); });
}

}  // namespace relucent::gui
