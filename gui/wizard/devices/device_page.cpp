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

std::optional<Banner> DevicePage::overTheShow() const {
  if (session_.isShownElsewhere() && !session_.isSimulated())
    return Banner{Banner::Kind::amber, tr("Another program plays a show of this venue"),
                  tr("End it before light is measured: its pictures may come between the patterns.")};
  if (!session_.underWay().show || session_.isSimulated() || !session_.areDevicesFree()) return std::nullopt;
  return Banner{Banner::Kind::information, tr("A show is playing"),
                tr("What is begun here shines in its place. The show is seen again once it has ended.")};
}

}  // namespace relucent::gui
