// SPDX-License-Identifier: MIT
// Stands in for gphoto_port.cpp where libgphoto2 or LibRaw is not installed.
#include "base/error.h"
#include "devices/gphoto_port.h"

namespace relucent {

bool hasGphoto() {
  return false;
}

std::unique_ptr<GphotoPort> makeGphotoPort() {
  throw Error(ErrorKind::device, "this build of Relucent does not know DSLR and mirrorless cameras",
              "install libgphoto2 and LibRaw (libgphoto2-dev, libraw-dev) and build again, or use a command");
}

}  // namespace relucent
