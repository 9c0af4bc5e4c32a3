// SPDX-License-Identifier: MIT
#include "remote/status_server.h"

#include <QSysInfo>
#include <QTcpSocket>
#include <QTimer>
#include <utility>

#include "relucent/base/error.h"
#include "remote/status_page.h"

namespace relucent::gui {
namespace {

/// What was asked and answered.
constexpr const char* answered = "answered";

/// Where the head of a request ends; -1: it has not yet.
qsizetype endOfHead(const QByteArray& received) {
  const qsizetype end = received.indexOf("\r\n\r\n");
  return end >= 0 ? end : received.indexOf("\n\n");
}

}  // namespace

StatusServer::StatusServer(const NetworkPlace& place, Health health, std::chrono::milliseconds longestVisit,
                           QObject* parent)
    : QObject(parent), health_(std::move(health)), longestVisit_(longestVisit) {
  if (!server_.listen(place.host, place.port))
    throw Error(
        ErrorKind::device,
        RELUCENT_ENGLISH_MESSAGE("show.status-port-taken", "the status page cannot be shown at {} ({})")
            .with(textOf(place).toStdString(), server_.errorString().toStdString()),
        RELUCENT_ENGLISH_MESSAGE(
            "show.status-choose-port",
            "choose another port with --status, or an address of this computer with --status-address"));
  connect(&server_, &QTcpServer::newConnection, this, [this] {
    while (QTcpSocket* visitor = server_.nextPendingConnection()) receive(visitor);
  });
}

void StatusServer::receive(QTcpSocket* visitor) {
  if (visitors_ >= mostVisitors) {
    visitor->abort();
    visitor->deleteLater();
    return;
  }
  ++visitors_;
  visitor->setReadBufferSize(longestRequest);
  // However it ends: a socket that is gone is no visitor.
  connect(visitor, &QObject::destroyed, this, [this] { --visitors_; });
  connect(visitor, &QTcpSocket::disconnected, visitor, &QObject::deleteLater);
  connect(visitor, &QTcpSocket::readyRead, this, [this, visitor] { read(visitor); });
  QTimer::singleShot(longestVisit_, visitor, [visitor] {
    visitor->abort();
    visitor->deleteLater();
  });
}

void StatusServer::read(QTcpSocket* visitor) {
  if (visitor->property(answered).toBool()) {
    visitor->readAll();
    return;
  }
  const QByteArray received = visitor->peek(longestRequest);
  const qsizetype end = endOfHead(received);
  if (end < 0 && received.size() < longestRequest) return;
  visitor->setProperty(answered, true);
  visitor->readAll();
  const HttpAnswer answer = end < 0
                                ? HttpAnswer{400, "text/plain; charset=utf-8", "this request is too long\n"}
                                : statusAnswer(received.left(end), QSysInfo::machineHostName(), health_());
  visitor->write(httpBytes(answer, !received.startsWith("HEAD ")));
  visitor->disconnectFromHost();
}

}  // namespace relucent::gui
