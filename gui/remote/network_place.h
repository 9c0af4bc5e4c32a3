// SPDX-License-Identifier: MIT
#pragma once

#include <QHostAddress>
#include <QString>
#include <optional>

namespace relucent::gui {

/// Where something listens, comes from, or goes to.
struct NetworkPlace {
  QHostAddress host;
  quint16 port = 0;

  bool operator==(const NetworkPlace&) const = default;
};
/// Of "host:port", the host as a number: "127.0.0.1:9000", "[::1]:9000"; none if it is none.
std::optional<NetworkPlace> networkPlaceFrom(const QString& text);
QString textOf(const NetworkPlace& place);

}  // namespace relucent::gui
