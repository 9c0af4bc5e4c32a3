// SPDX-License-Identifier: MIT
#include "wizard/session/device_label.h"

#include <QCoreApplication>

namespace relucent::gui {

QString projectorLabel(const Session& session, std::size_t projector) {
  const QString name = session.projectorName(projector);
  return name.isEmpty() ? QCoreApplication::translate("DeviceLabel", "Projector %1").arg(projector + 1)
                        : name;
}

QString cameraLabel(const Session& session, std::size_t camera) {
  const QString name = session.cameraName(camera);
  return name.isEmpty() ? QCoreApplication::translate("DeviceLabel", "Camera %1").arg(camera + 1) : name;
}

}  // namespace relucent::gui
