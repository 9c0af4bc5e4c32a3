// SPDX-License-Identifier: MIT
#include "remote/network_place.h"

namespace relucent::gui {

QString textOf(const NetworkPlace& place) {
  const bool isLong = place.host.protocol() == QAbstractSocket::IPv6Protocol;
  return QString(isLong ? "[%1]:%2" : "%1:%2").arg(place.host.toString()).arg(place.port);
}

std::optional<NetworkPlace> networkPlaceFrom(const QString& text) {
  const qsizetype colon = text.lastIndexOf(':');
  if (colon < 0) return std::nullopt;
  QString host = text.left(colon);
  if (host.startsWith('[') && host.endsWith(']')) host = host.mid(1, host.size() - 2);
  bool isNumber = false;
  const quint16 port = text.mid(colon + 1).toUShort(&isNumber);
  NetworkPlace place{QHostAddress(host), port};
  if (place.host.isNull() || !isNumber || port == 0) return std::nullopt;
  return place;
}

}  // namespace relucent::gui
