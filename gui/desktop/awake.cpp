// SPDX-License-Identifier: MIT
#include "desktop/awake.h"

#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusReply>

namespace relucent::gui {
namespace {

constexpr int patience = 2000;  // milliseconds for an answer

QDBusMessage screenSaverCall(const char* method) {
  return QDBusMessage::createMethodCall("org.freedesktop.ScreenSaver", "/org/freedesktop/ScreenSaver",
                                        "org.freedesktop.ScreenSaver", method);
}

}  // namespace

Awake::Awake(const QString& why) {
  QDBusMessage inhibit = QDBusMessage::createMethodCall("org.freedesktop.login1", "/org/freedesktop/login1",
                                                        "org.freedesktop.login1.Manager", "Inhibit");
  inhibit << "sleep:idle:handle-lid-switch"
          << "Relucent" << why << "block";
  QDBusReply<QDBusUnixFileDescriptor> held =
      QDBusConnection::systemBus().call(inhibit, QDBus::Block, patience);
  if (held.isValid())
    sleep_ = held.value();
  else
    problems_.append("the system may go to sleep: " + held.error().message());

  QDBusMessage noSaver = screenSaverCall("Inhibit");
  noSaver << "Relucent" << why;
  QDBusReply<quint32> cookie = QDBusConnection::sessionBus().call(noSaver, QDBus::Block, patience);
  screenSaverInhibited_ = cookie.isValid();
  if (cookie.isValid())
    screenSaver_ = cookie.value();
  else
    problems_.append("a screen saver may appear: " + cookie.error().message());

  displays_.keepAwake();
  if (!displays_.problem().isEmpty()) problems_.append(displays_.problem());
}

bool Awake::wakeDisplays() {
  if (!displays_.hasSlept()) return false;
  displays_.wake();
  return true;
}

Awake::~Awake() {
  if (!screenSaverInhibited_) return;
  QDBusMessage release = screenSaverCall("UnInhibit");
  release << screenSaver_;
  QDBusConnection::sessionBus().send(release);
}

}  // namespace relucent::gui
