// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "relucent/image/image.h"
#include "relucent/rig/rig.h"

namespace relucent::venue {

/// Faults that can be simulated while the devices are used.
enum class FaultKind {
  flicker,          // every other exposure is brighter by `amount`, relative
  ambient,          // room light rises by `amount` of the mean of what the camera sees at full light
  shiftedCamera,    // the view is shifted by `amount` pixels to the right and down, and turned by `degrees`
  mirroredScreen,   // pictures appear mirrored left to right
  coveredLens,      // the camera sees nothing
  asleepProjector,  // projectors emit nothing, not even their black level
  flash,            // a part of the view is brighter by `amount`, camera signal per second
  hand,             // a part of the view is dark
  unplugged,        // the camera does not answer
};

/// Whether all cameras see it; the others are of one camera and of what stands before it.
constexpr bool isOfTheRoom(FaultKind kind) {
  return kind == FaultKind::flicker || kind == FaultKind::ambient || kind == FaultKind::mirroredScreen ||
         kind == FaultKind::asleepProjector;
}

/// One fault, during shots [first, last] of a stage; `flash` and `hand` affect the rectangle [x0, x1) x [y0,
/// y1) as shares of its width and height.
struct DeviceFault {
  FaultKind kind = FaultKind::flicker;
  std::string stage;
  int first = 0;
  int last = 0;
  double amount = 0.0;
  double degrees = 0.0;
  double x0 = 0.0, y0 = 0.0, x1 = 1.0, y1 = 1.0;
};

/// Faults at certain shots, of a rig of simulated devices. May be changed while the rig is in use, by the
/// thread that uses it.
struct FaultSchedule {
  std::vector<DeviceFault> faults;

  /// The faults that are active during a shot.
  std::vector<DeviceFault> during(const rig::ShotId& shot) const;
};

/// Throws: Error{device} where the camera is unplugged.
void requireConnected(const std::vector<DeviceFault>& faults, const std::string& camera);
/// The picture as it reaches the wall.
image::Image withFaults(const image::Image& encodedDrive, const std::vector<DeviceFault>& faults);
/// The light that reaches the sensor. `full`: mean radiance at full light.  Shapes: three channels a pixel.
Stack withFaults(Stack fromProjectors, const Stack& ambient, Size size, double full, int exposure,
                 const std::vector<DeviceFault>& faults);

}  // namespace relucent::venue
