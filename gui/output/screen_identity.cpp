// SPDX-License-Identifier: MIT
#include "output/screen_identity.h"

#include <QGuiApplication>
#include <cmath>

#include "desktop/wayland_compositor.h"

namespace relucent::gui {

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

int nativeLength(int scaled, double ratio) {
  const int nearest = qRound(scaled * ratio), reach = static_cast<int>(std::ceil(ratio));
  int best = nearest, bestDivisor = 1;
  for (int length = nearest - reach; length <= nearest + reach; ++length) {
    const int divisor = length & -length;  // the largest power of two
    if (qRound(length / ratio) == scaled && divisor > bestDivisor) {
      best = length;
      bestDivisor = divisor;
    }
  }
  return best;
}

QSize nativeSize(QSize scaled, double ratio) {
  return {nativeLength(scaled.width(), ratio), nativeLength(scaled.height(), ratio)};
}

QSize nativeSize(const QScreen& screen) {
  if (WaylandCompositor* compositor = WaylandCompositor::instance())
    if (const QSize pixels = compositor->pixelsOf(screen); !pixels.isEmpty()) return pixels;
  return nativeSize(screen.geometry().size(), screen.devicePixelRatio());
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

}  // namespace relucent::gui
