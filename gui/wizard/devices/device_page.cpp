// SPDX-License-Identifier: MIT
#include "wizard/devices/device_page.h"

namespace relucent::gui {

DevicePage::DevicePage(const StepName& step, Session& session, QObject* parent)
    : PageModel(step, parent), session_(session) {
  connect(&session_, &Session::opened, this, [this] { projector_ = camera_ = 0; });
}

void DevicePage::showProjector(std::size_t projector) {
  if (projector == projector_ || projector >= projectors()) return;
  projector_ = projector;
  projectorChanged();
  tellSettings();
}

void DevicePage::showCamera(std::size_t camera) {
  if (camera == camera_ || camera >= cameras()) return;
  camera_ = camera;
  cameraChanged();
  tellSettings();
}

}  // namespace relucent::gui
