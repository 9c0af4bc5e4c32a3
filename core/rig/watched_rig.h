// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "rig/rig.h"

namespace relucent {

/// Looks on while devices are used, from the thread that uses them. What it throws ends the measurement like
/// a failure of the device.
class RigWatcher {
 public:
  virtual ~RigWatcher() = default;
  /// A pattern is about to be shown. May wait, which is how a measurement is paused: projectors that are
  /// given through `projector` show what they are asked to meanwhile.
  virtual void beforeShowing(std::size_t /*index*/, Projector& /*projector*/) {}
  virtual void shown(std::size_t /*index*/, const Image& /*encodedDrive*/) {}
  virtual void photographed(std::size_t /*index*/, const CaptureRequest&, const RawFrame&) {}
};

/// The same devices, watched. The frames are the devices' own, bit for bit.
Rig watched(Rig rig, std::shared_ptr<RigWatcher> watcher);

}  // namespace relucent
