// SPDX-License-Identifier: MIT
#include "relucent/base/message.h"
#include "relucent/devices/camera_kind.h"
#include "relucent/devices/genicam/genicam_driver.h"

namespace relucent::devices {
namespace {

std::unique_ptr<rig::Camera> openGenicam(const std::string& place, const CameraWishes& wishes) {
  GenicamSettings settings;
  settings.camera = place;
  settings.photograph = wishes.size;
  return std::make_unique<DrivenCamera>(makeGenicamDriver(settings));
}

std::vector<ListedCamera> listGenicam() {
  std::vector<ListedCamera> cameras;
  for (const GenicamCamera& found : findGenicamCameras()) {
    GenicamSettings settings;
    settings.camera = found.serial.empty() ? found.address : found.serial;
    cameras.push_back(judged("genicam:" + settings.camera, Message::plain(found.model),
                             [&] { return makeGenicamDriver(settings); }, {}));
  }
  return cameras;
}

}  // namespace

CameraKind genicamKind() {
  return {
      .prefix = "genicam",
      .place = "SERIAL",
      .help = "GigE Vision or USB3 Vision; also its network address",
      .support = RELUCENT_ENGLISH_MESSAGE("device.genicam-cameras", "GigE Vision and USB3 Vision cameras"),
      .open = openGenicam,
      .list = listGenicam,
      .devices = genicamDevices};
}

}  // namespace relucent::devices
