// SPDX-License-Identifier: MIT
// Stands in for gphoto2.cpp where libgphoto2 or LibRaw is not installed.
#include "relucent/base/error.h"
#include "relucent/devices/camera_kind.h"

namespace relucent::devices {
namespace {

std::unique_ptr<rig::Camera> openGphoto(const std::string& place, const CameraWishes&) {
  throw Error(
      ErrorKind::device,
      RELUCENT_MESSAGE("device.built-without-gphoto",
                       "this build of Relucent does not know DSLR and mirrorless cameras"),
      RELUCENT_MESSAGE(
          "device.install-libgphoto2",
          "install libgphoto2 and LibRaw (libgphoto2-dev, libraw-dev) and build again, or use a command"),
      place);
}

}  // namespace

CameraKind gphoto2Kind() {
  return {.prefix = "gphoto2",
          .place = "MODEL",
          .help = "DSLR or mirrorless camera; not in this build",
          .support = RELUCENT_MESSAGE("device.gphoto-missing",
                                      "DSLR and mirrorless cameras: this build lacks libgphoto2 or LibRaw; "
                                      "install libgphoto2-dev and libraw-dev and build again"),
          .isBuiltIn = false,
          .open = openGphoto};
}

}  // namespace relucent::devices
