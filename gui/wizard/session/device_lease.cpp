// SPDX-License-Identifier: MIT
#include "wizard/session/device_lease.h"

#include <utility>

#include "wizard/session/session.h"

namespace relucent::gui {

DeviceLease::DeviceLease(Session& session) : session_(&session) {}

DeviceLease::DeviceLease(DeviceLease&& other) noexcept : session_(std::exchange(other.session_, nullptr)) {}

DeviceLease& DeviceLease::operator=(DeviceLease&& other) noexcept {
  if (this == &other) return *this;
  release();
  session_ = std::exchange(other.session_, nullptr);
  return *this;
}

DeviceLease::~DeviceLease() {
  if (!session_) return;
  session_->takeBackDevices();
  QMetaObject::invokeMethod(session_, &Session::devicesChanged, Qt::QueuedConnection);
}

void DeviceLease::release() {
  QPointer<Session> session = std::exchange(session_, nullptr);
  if (!session) return;
  session->takeBackDevices();
  Q_EMIT session->devicesChanged();
}

}  // namespace relucent::gui
