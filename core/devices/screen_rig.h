// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "relucent/devices/check/latency.h"
#include "relucent/rig/rig.h"

namespace relucent::devices {

/// A projector that is a screen of the desktop: it is unplugged, sleeps, and belongs to others between two
/// measurements.
class ScreenProjector : public rig::Projector {
 public:
  /// As Projector::show(): returns after the swap. Waits while the screen is not there.
  /// Throws: Cancelled if it is asked to stop meanwhile; Error{device}.
  void show(const image::Image& encodedDrive) override = 0;
  /// Whether the picture of the last show() has stood on the screen ever since.
  virtual bool stayedVisible() = 0;
  /// Leaves the screen to whoever else shows on it, until the next show(). From any thread; does not wait.
  virtual void rest() = 0;
};

/// What can be changed about a screen that is in use. From any thread.
class ScreenControl {
 public:
  virtual ~ScreenControl() = default;
  /// From the swap until the picture is out, seconds.
  virtual void setLatency(double seconds) = 0;
  virtual void rest() = 0;
  /// Whether exposures become whole frames of the screen (devices/whole_frames.h); true to begin with.
  virtual void setWholeFrames(bool whole) = 0;
};

/// How a screen is to be waited for, seconds.
struct ScreenTiming {
  double latency = 0.0;       // from the swap until the picture is out
  double frame = 1.0 / 60.0;  // that one picture is shown
};

struct ScreenRig {
  rig::Rig rig;
  std::shared_ptr<ScreenControl> control;  // lives as long as the rig's devices or longer
};

/// A screen and a camera before it. show() returns `latency` seconds after the swap; exposures are whole
/// frames where the camera can. A photograph during
/// which the screen lost its picture is taken again, once the picture is back: what is unplugged costs time
/// and nothing else. The camera throws Error{device} if the picture is lost again and again.
ScreenRig screenRig(std::unique_ptr<ScreenProjector> screen, std::unique_ptr<rig::Camera> camera,
                    const ScreenTiming& timing, Wait wait);
/// Several of both: a photograph counts only if all screens kept their pictures. `timing`: the slowest
/// screen's.  Contract: there is a screen and a camera.
ScreenRig screenRig(std::vector<std::unique_ptr<ScreenProjector>> screens,
                    std::vector<std::unique_ptr<rig::Camera>> cameras, const ScreenTiming& timing, Wait wait);

}  // namespace relucent::devices
