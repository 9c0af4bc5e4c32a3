// SPDX-License-Identifier: MIT
// Stands in for genicam.cpp where Aravis is not installed.
#include "relucent/base/error.h"
#include "relucent/devices/camera_kind.h"

namespace relucent::devices {
namespace {

std::unique_ptr<rig::Camera> openGenicam(const std::string& place, const CameraWishes&) {
  throw Error(
      ErrorKind::device,
      RELUCENT_MESSAGE("device.built-without-genicam",
                       "this build of Relucent does not know GenICam cameras"),
      RELUCENT_MESSAGE("device.install-aravis",
                       "install Aravis (libaravis-dev) and build again, or use another kind of camera"),
      place);
}

}  // namespace

CameraKind genicamKind() {
  return {.prefix = "genicam",
          .place = "SERIAL",
          .help = "GigE Vision or USB3 Vision; not in this build",
          .support = RELUCENT_MESSAGE("device.genicam-missing",
                                      "GigE Vision and USB3 Vision cameras: this build lacks Aravis; install "
                                      "libaravis-dev and build again"),
          .isBuiltIn = false,
          .open = openGenicam};
}

}  // namespace relucent::devices
