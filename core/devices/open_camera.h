// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "devices/device_address.h"
#include "rig/rig.h"

namespace relucent {

struct CameraWishes {
  std::optional<Size> size;            // of photographs; none: all that the camera has
  ExposureRange exposures{1e-3, 4.0};  // of external programs, which cannot be asked
};

/// The camera at an address, ready for use. Throws: Error{device} if it is not there or cannot be used;
/// Error{usage} for a command without {exposure} and {output}.
std::unique_ptr<Camera> openCamera(const DeviceAddress& address, const CameraWishes& wishes);

}  // namespace relucent
