// SPDX-License-Identifier: MIT
#include "wizard/frame/lost_device.h"

#include <QCoreApplication>

#include "wizard/session/device_label.h"

namespace relucent::gui {
namespace {

QString whatIsUnplugged(const Session& session) {
  const std::optional<std::size_t> projector = session.projectorWithoutScreen();
  if (session.projectors() < 2 || !projector)
    return QCoreApplication::translate("LostDevice", "The projector's screen is unplugged");
  //: %1 is a projector: its name, or "Projector 2"
  return QCoreApplication::translate("LostDevice", "%1: its screen is unplugged")
      .arg(projectorLabel(session, *projector));
}

QString whatIsSilent(const Session& session) {
  const std::optional<std::size_t> camera = session.silentCamera();
  if (session.cameras() < 2 || !camera)
    return QCoreApplication::translate("LostDevice", "The camera does not answer");
  //: %1 is a camera: its name, or "Camera 2"
  return QCoreApplication::translate("LostDevice", "%1 does not answer").arg(cameraLabel(session, *camera));
}

}  // namespace

std::optional<Banner> lostDeviceBanner(const Session& session, PageCommand* instead) {
  // Paused as well, nothing goes on by itself.
  const bool isPaused = session.isOpen() && session.live().isPaused();
  if (session.isScreenMissing())
    return Banner{
        Banner::Kind::amber, whatIsUnplugged(session),
        isPaused ? QCoreApplication::translate("LostDevice",
                                               "Everything so far is safe. Plug it in again, then resume.")
                 : QCoreApplication::translate(
                       "LostDevice", "Everything so far is safe. Plug it in again: it goes on by itself.")};
  if (!session.isCameraSilent()) return std::nullopt;
  const QString advice =
      isPaused
          ? QCoreApplication::translate("LostDevice",
                                        "Everything so far is safe. Push in its cable at both ends, and do "
                                        "not move the tripod, then resume.")
          : QCoreApplication::translate("LostDevice",
                                        "Everything so far is safe. Push in its cable at both ends, and do "
                                        "not move the tripod: it goes on by itself.");
  const QString& why = session.cameraFailure();
  return Banner{Banner::Kind::amber, whatIsSilent(session), why.isEmpty() ? advice : why + ' ' + advice,
                instead};
}

QString lostDeviceText(const Session& session) {
  return session.isScreenMissing() ? QCoreApplication::translate("LostDevice", "Screen unplugged")
                                   : QCoreApplication::translate("LostDevice", "Camera silent");
}

}  // namespace relucent::gui
