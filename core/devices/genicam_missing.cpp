// SPDX-License-Identifier: MIT
// Stands in for aravis_driver.cpp where Aravis is not installed.
#include "base/error.h"
#include "devices/genicam_driver.h"

namespace relucent {

bool hasGenicam() {
  return false;
}

std::vector<GenicamCamera> findGenicamCameras() {
  return {};
}

std::unique_ptr<CameraDriver> makeGenicamDriver(const GenicamSettings& settings) {
  throw Error(ErrorKind::device, "this build of Relucent does not know GenICam cameras",
              "install Aravis (libaravis-dev) and build again, or use another kind of camera",
              settings.camera);
}

}  // namespace relucent
