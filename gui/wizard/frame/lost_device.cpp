// SPDX-License-Identifier: MIT
#include "wizard/frame/lost_device.h"

#include <QCoreApplication>

namespace relucent::gui {

std::optional<Banner> lostDeviceBanner(const Session& session, PageCommand* instead) {
  if (session.isScreenMissing())
    return Banner{Banner::Kind::amber,
                  QCoreApplication::translate("LostDevice", "The projector's screen is unplugged"),
                  QCoreApplication::translate(
                      "LostDevice", "Everything so far is safe. Plug it in again: it goes on by itself.")};
  if (!session.isCameraSilent()) return std::nullopt;
  const QString advice = QCoreApplication::translate(
      "LostDevice",
      "Everything so far is safe. Push in its cable at both ends, and do not move the tripod: it goes on by "
      "itself.");
  const QString& why = session.cameraFailure();
  return Banner{Banner::Kind::amber, QCoreApplication::translate("LostDevice", "The camera does not answer"),
                why.isEmpty() ? advice : why + ' ' + advice, instead};
}

QString lostDeviceText(const Session& session) {
  return session.isScreenMissing() ? QCoreApplication::translate("LostDevice", "Screen unplugged")
                                   : QCoreApplication::translate("LostDevice", "Camera silent");
}

}  // namespace relucent::gui
