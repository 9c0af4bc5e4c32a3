// SPDX-License-Identifier: MIT
#include "desktop/platform_choice.h"

#include <QtGlobal>

namespace relucent::gui {

QByteArray platformChoice(const QByteArray& wanted, const QByteArray& waylandDisplay) {
  if (!wanted.isEmpty()) return wanted;
  return waylandDisplay.isEmpty() ? QByteArray() : QByteArray("wayland;xcb");
}

void choosePlatform() {
  const QByteArray choice = platformChoice(qgetenv("QT_QPA_PLATFORM"), qgetenv("WAYLAND_DISPLAY"));
  if (!choice.isEmpty()) qputenv("QT_QPA_PLATFORM", choice);
}

}  // namespace relucent::gui
