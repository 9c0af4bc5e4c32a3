// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QString>
#include <QUdpSocket>
#include <chrono>
#include <functional>
#include <optional>

#include "remote/network_place.h"
#include "remote/osc_message.h"

namespace relucent::gui {

/// Receives OSC messages by UDP on the present thread. What is no OSC, and more than `mostPerSecond` messages
/// in a second, is ignored; either is told by one sentence, and again after a minute at the earliest.
class OscServer : public QObject {
  Q_OBJECT

 public:
  using Time = std::chrono::steady_clock::time_point;
  using Now = std::function<Time()>;
  static constexpr int mostPerSecond = 1000;

  /// Binds to `place`; port 0: any free one.  Throws: Error{device} if it cannot.
  explicit OscServer(const NetworkPlace& place, Now now = std::chrono::steady_clock::now,
                     QObject* parent = nullptr);

  NetworkPlace place() const { return {socket_.localAddress(), socket_.localPort()}; }
  Time now() const { return now_(); }
  /// What cannot be sent is lost, as with UDP.
  void send(const OscMessage& message, const NetworkPlace& to);

 Q_SIGNALS:
  void received(const relucent::gui::OscMessage& message, const relucent::gui::NetworkPlace& from);
  /// A sentence for the log.
  void warned(const QString& sentence);

 private:
  void read();
  bool isFlooded(Time now, int more);
  void warn(std::optional<Time>& last, Time now, const QString& sentence);

  QUdpSocket socket_;
  Now now_;
  Time second_{};
  int inSecond_ = 0;
  std::optional<Time> toldGarbage_, toldFlood_;
};

}  // namespace relucent::gui
