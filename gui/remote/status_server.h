// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonObject>
#include <QObject>
#include <QTcpServer>
#include <chrono>
#include <functional>

#include "remote/network_place.h"

namespace relucent::gui {

/// Shows a show's facts to browsers and monitoring, read only (status_page.h), on the present thread. No
/// visitor can keep it busy: there are bounds on how many there are at a time, on what they send, and on how
/// long they stay; who comes beyond them is turned away.
class StatusServer : public QObject {
  Q_OBJECT

 public:
  static constexpr int mostVisitors = 16;
  static constexpr qint64 longestRequest = 8192;  // bytes

  using Health = std::function<QJsonObject()>;
  /// Binds to `place`; port 0: any free one. `longestVisit`: until the answer has left.
  /// Throws: Error{device} if it cannot.
  StatusServer(const NetworkPlace& place, Health health,
               std::chrono::milliseconds longestVisit = std::chrono::seconds(5), QObject* parent = nullptr);

  NetworkPlace place() const { return {server_.serverAddress(), server_.serverPort()}; }
  /// That are here now.
  int visitors() const { return visitors_; }

 private:
  void receive(QTcpSocket* visitor);
  void read(QTcpSocket* visitor);

  Health health_;
  std::chrono::milliseconds longestVisit_;
  int visitors_ = 0;
  QTcpServer server_;  // last: visitors that leave with it are counted
};

}  // namespace relucent::gui
