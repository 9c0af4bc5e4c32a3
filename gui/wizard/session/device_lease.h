// SPDX-License-Identifier: MIT
#pragma once

#include <QPointer>

namespace relucent::gui {

class Session;

/// The devices of the open calibration, held by one step for as long as this lives. Made by
/// Session::leaseDevices(). Movable; what was moved from, and what is made of nothing, holds none.
class DeviceLease {
 public:
  DeviceLease() = default;
  /// Session::devicesChanged() comes later then: whoever held it may be half gone.
  ~DeviceLease();
  DeviceLease(DeviceLease&& other) noexcept;
  DeviceLease& operator=(DeviceLease&& other) noexcept;

  bool isHeld() const { return !session_.isNull(); }
  /// Before its time ends. Session::devicesChanged() tells.
  void release();

 private:
  friend class Session;
  explicit DeviceLease(Session& session);
  QPointer<Session> session_;  // none: nothing is held
};

}  // namespace relucent::gui
