// SPDX-License-Identifier: MIT
#include "remote/osc_server.h"

#include <QNetworkDatagram>
#include <utility>

#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

constexpr std::chrono::minutes betweenSentences{1};

}  // namespace

OscServer::OscServer(const NetworkPlace& place, Now now, QObject* parent)
    : QObject(parent), now_(std::move(now)) {
  // Two shows on one port would each get some of the messages.
  if (!socket_.bind(place.host, place.port, QAbstractSocket::DontShareAddress))
    throw Error(ErrorKind::device,
                RELUCENT_ENGLISH_MESSAGE("show.osc-port-taken", "OSC messages cannot be received at {} ({})")
                    .with(textOf(place).toStdString(), socket_.errorString().toStdString()),
                RELUCENT_ENGLISH_MESSAGE(
                    "show.osc-choose-port",
                    "choose another port with --osc, or an address of this computer with --osc-address"));
  connect(&socket_, &QUdpSocket::readyRead, this, &OscServer::read);
}

void OscServer::send(const OscMessage& message, const NetworkPlace& to) {
  socket_.writeDatagram(oscDatagram(message), to.host, to.port);
}

void OscServer::warn(std::optional<Time>& last, Time now, const QString& sentence) {
  if (last && now - *last < betweenSentences) return;
  last = now;
  Q_EMIT warned(sentence);
}

bool OscServer::isFlooded(Time now, int more) {
  if (now - second_ >= std::chrono::seconds(1)) {
    second_ = now;
    inSecond_ = 0;
  }
  inSecond_ += more;
  return inSecond_ > mostPerSecond;
}

void OscServer::read() {
  // Not for ever: whoever sends faster than this reads must not keep the show from playing.
  for (int datagrams = 0; socket_.hasPendingDatagrams() && datagrams < mostPerSecond; ++datagrams) {
    const QNetworkDatagram datagram = socket_.receiveDatagram();
    const Time now = now_();
    const NetworkPlace from{datagram.senderAddress(), static_cast<quint16>(datagram.senderPort())};
    const auto messages = oscMessages(datagram.data());
    const int count = messages ? static_cast<int>(messages->size()) : 1;
    if (isFlooded(now, count)) {
      warn(toldFlood_, now,
           QString("more than %1 OSC messages a second, the last from %2: those beyond are ignored")
               .arg(mostPerSecond)
               .arg(textOf(from)));
    } else if (!messages) {
      warn(toldGarbage_, now, QString("what %1 sends is no OSC message, and is ignored").arg(textOf(from)));
    } else {
      for (const OscMessage& message : *messages) Q_EMIT received(message, from);
    }
  }
  // What is left does not announce itself again.
  if (socket_.hasPendingDatagrams()) QMetaObject::invokeMethod(this, &OscServer::read, Qt::QueuedConnection);
}

}  // namespace relucent::gui
