// SPDX-License-Identifier: MIT
#include "output/screen_identity.h"

#include <QGuiApplication>

namespace relucent {

ScreenIdentity identityOf(const QScreen& screen) {
  return {screen.name(), screen.manufacturer(), screen.model(), screen.serialNumber()};
}

std::optional<qsizetype> findScreen(const ScreenIdentity& wanted, const QList<ScreenIdentity>& present) {
  std::optional<qsizetype> alike, onConnector;
  int count = 0;
  for (qsizetype i = 0; i < present.size(); ++i) {
    const ScreenIdentity& screen = present[i];
    if (screen.manufacturer != wanted.manufacturer || screen.model != wanted.model ||
        screen.serialNumber != wanted.serialNumber)
      continue;
    ++count;
    alike = i;
    if (screen.connector == wanted.connector) onConnector = i;
  }
  if (!wanted.serialNumber.isEmpty() && count == 1) return alike;
  return onConnector;
}

QScreen* findScreen(const ScreenIdentity& wanted) {
  const QList<QScreen*> screens = QGuiApplication::screens();
  QList<ScreenIdentity> present;
  for (const QScreen* screen : screens) present.append(identityOf(*screen));
  std::optional<qsizetype> found = findScreen(wanted, present);
  return found ? screens[*found] : nullptr;
}

QSize nativeSize(const QScreen& screen) {
  return (QSizeF(screen.geometry().size()) * screen.devicePixelRatio()).toSize();
}

QJsonObject toJson(const ScreenIdentity& identity) {
  return {{"connector", identity.connector},
          {"manufacturer", identity.manufacturer},
          {"model", identity.model},
          {"serial_number", identity.serialNumber}};
}

ScreenIdentity screenIdentityFrom(const QJsonObject& json) {
  return {json["connector"].toString(), json["manufacturer"].toString(), json["model"].toString(),
          json["serial_number"].toString()};
}

}  // namespace relucent
