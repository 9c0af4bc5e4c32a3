// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "relucent/rig/rig.h"

namespace relucent::rig {

/// The pictures of all projectors of a watched rig, for a watcher that pauses them.
class RigLight {
 public:
  virtual ~RigLight() = default;
  /// Shows black on all projectors.
  virtual void darken() = 0;
  /// Restores the pictures, except on the projector whose pattern comes next.
  virtual void restore() = 0;
};

/// Observes the use of devices, on the thread that uses them. An exception from it ends the measurement like
/// a failure of the device.
class RigWatcher {
 public:
  virtual ~RigWatcher() = default;
  /// A pattern is about to be shown. May block to pause a measurement, using `light` to show black meanwhile.
  virtual void beforeShowing(std::size_t /*index*/, RigLight& /*light*/) {}
  virtual void shown(std::size_t /*index*/, const image::Image& /*encodedDrive*/) {}
  /// A photograph is asked for; afterPhotographing() follows in any case, also where it fails.
  virtual void beforePhotographing(std::size_t /*index*/, const CaptureRequest&) {}
  virtual void afterPhotographing(std::size_t /*index*/) noexcept {}
  virtual void photographed(std::size_t /*index*/, const CaptureRequest&, const RawFrame&) {}
};

/// Wraps the devices with a watcher. Frames are passed through unchanged.
Rig watched(Rig rig, const std::shared_ptr<RigWatcher>& watcher);

}  // namespace relucent::rig
