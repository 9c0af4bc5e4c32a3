// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "rig/rig.h"

namespace relucent {

/// What all projectors of a watched rig show, for a watcher that holds them up.
class RigLight {
 public:
  virtual ~RigLight() = default;
  /// All of them show black.
  virtual void darken() = 0;
  /// They show again what they showed, but for the one whose pattern comes now.
  virtual void restore() = 0;
};

/// Looks on while devices are used, from the thread that uses them. What it throws ends the measurement like
/// a failure of the device.
class RigWatcher {
 public:
  virtual ~RigWatcher() = default;
  /// A pattern is about to be shown. May wait, which is how a measurement is paused: `light` is darkened
  /// meanwhile.
  virtual void beforeShowing(std::size_t /*index*/, RigLight& /*light*/) {}
  virtual void shown(std::size_t /*index*/, const Image& /*encodedDrive*/) {}
  virtual void photographed(std::size_t /*index*/, const CaptureRequest&, const RawFrame&) {}
};

/// The same devices, watched. The frames are the devices' own, bit for bit.
Rig watched(Rig rig, std::shared_ptr<RigWatcher> watcher);

}  // namespace relucent
