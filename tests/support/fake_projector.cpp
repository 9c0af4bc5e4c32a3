// SPDX-License-Identifier: MIT
#include "support/fake_projector.h"

#include <QCryptographicHash>
#include <QNetworkDatagram>
#include <QTcpServer>
#include <QTcpSocket>
#include <QTimer>
#include <QUdpSocket>
#include <utility>

namespace relucent::test {
namespace {

constexpr const char* challenge = "498e4a67";  // the specification's own example

}  // namespace

/// Lives on the projector's thread; what tests ask for is guarded.
class FakeProjector::Machine : public QObject {
 public:
  Machine(FakeProjectorState begins, ProjectorFault wrong) : state(std::move(begins)), fault(wrong) {}

  mutable std::mutex guard;
  FakeProjectorState state;
  ProjectorFault fault;
  std::function<QByteArray(const QByteArray&)> mangle;
  QStringList orders;
  int connections = 0;
  quint16 port = 0;

  void listen(quint16 wanted) {
    server_ = new QTcpServer(this);
    server_->listen(QHostAddress::LocalHost, wanted);
    port = server_->serverPort();
    connect(server_, &QTcpServer::newConnection, this, [this] {
      while (QTcpSocket* visitor = server_->nextPendingConnection()) greet(visitor);
    });
  }

  void beFound() {
    auto* socket = new QUdpSocket(this);
    socket->bind(QHostAddress::LocalHost, port);
    connect(socket, &QUdpSocket::readyRead, this, [socket] {
      while (socket->hasPendingDatagrams()) {
        const QNetworkDatagram asked = socket->receiveDatagram();
        if (asked.data() != "%2SRCH\r") continue;
        // With what is no answer before it, and twice.
        for (const char* reply :
             {"%2ACKN=nothing\r", "\xff\xfe", "%2ACKN=01:23:45:67:89:ab\r", "%2ACKN=01:23:45:67:89:ab\r"})
          socket->writeDatagram(reply, asked.senderAddress(), static_cast<quint16>(asked.senderPort()));
      }
    });
  }

 private:
  struct Visitor {
    QByteArray received, before;
    bool authenticated = false;
  };

  void greet(QTcpSocket* visitor) {
    const std::lock_guard lock(guard);
    ++connections;
    connect(visitor, &QTcpSocket::disconnected, visitor, &QObject::deleteLater);
    switch (fault) {
      case ProjectorFault::silent:
        return;
      case ProjectorFault::closesAtOnce:
        return visitor->disconnectFromHost();
      case ProjectorFault::otherProtocol:
        visitor->write("HTTP/1.0 400 Bad Request\r\n\r\n");
        return;
      case ProjectorFault::newerPassword:
        visitor->write("PJLINK 2 0123456789abcdef0123456789abcdef\r");
        return;
      case ProjectorFault::tooManyVisitors:
        visitor->write("PJLINK ERRA\r");
        return;
      default:
        break;
    }
    visitor->write(state.password.isEmpty() ? QByteArray("PJLINK 0\r")
                                            : QByteArray("PJLINK 1 ") + challenge + "\r");
    auto kept = std::make_shared<Visitor>();
    kept->authenticated = state.password.isEmpty();
    connect(visitor, &QTcpSocket::readyRead, visitor, [this, visitor, kept] {
      kept->received += visitor->readAll();
      for (qsizetype end = kept->received.indexOf('\r'); end >= 0; end = kept->received.indexOf('\r')) {
        const QByteArray line = kept->received.left(end);
        kept->received.remove(0, end + 1);
        hear(visitor, *kept, line);
      }
    });
  }

  void hear(QTcpSocket* visitor, Visitor& kept, QByteArray line) {
    const std::lock_guard lock(guard);
    if (!kept.authenticated) {
      const QByteArray digest =
          QCryptographicHash::hash(challenge + state.password.toUtf8(), QCryptographicHash::Md5).toHex();
      if (!line.startsWith(digest)) {
        visitor->write("PJLINK ERRA\r");
        return visitor->disconnectFromHost();
      }
      line.remove(0, digest.size());
      kept.authenticated = true;
    }
    QByteArray answer = line.left(6) + "=" + answerTo(line) + "\r";
    const QByteArray before = std::exchange(kept.before, answer);
    if (mangle) answer = mangle(answer);
    say(visitor, before, answer);
  }

  void say(QTcpSocket* visitor, const QByteArray& before, const QByteArray& answer) {
    switch (fault) {
      case ProjectorFault::garbage:
        visitor->write("\xff\x01 =%\r");
        return;
      case ProjectorFault::overlong:
        visitor->write(QByteArray(100'000, '1'));
        return;
      case ProjectorFault::halfLine:
        visitor->write(answer.left(answer.size() / 2));
        return;
      case ProjectorFault::silentAfterGreeting:
        return;
      case ProjectorFault::closesMidAnswer:
        visitor->write(answer.left(answer.size() / 2));
        return visitor->disconnectFromHost();
      case ProjectorFault::lateAnswers:
        visitor->write(before + answer);
        return;
      case ProjectorFault::slowBytes: {
        auto* timer = new QTimer(visitor);
        connect(timer, &QTimer::timeout, visitor, [visitor] { visitor->write("1"); });
        timer->start(20);
        return;
      }
      default:
        visitor->write(answer);
    }
  }

  /// The value of the answer; an order changes the state.
  QByteArray answerTo(const QByteArray& line) {
    const QByteArray command = line.mid(2, 4), parameter = line.mid(7);
    if (fault == ProjectorFault::failure) return "ERR4";
    const bool asks = parameter.startsWith('?');
    if (!asks) orders.append(QString::fromLatin1(command + " " + parameter));
    if (command == "POWR") return asks ? power() : order(parameter);
    if (fault == ProjectorFault::unavailable) return "ERR3";
    if (command == "AVMT" && !asks) return mute(parameter);
    if (!asks) return "ERR1";
    if (line.startsWith("%2") && state.protocolClass != "2") return "ERR1";
    const QByteArray value = said(command);
    return value.isEmpty() ? QByteArray("ERR1") : value;
  }

  QByteArray said(const QByteArray& command) const {
    if (command == "AVMT") return state.shutter;
    if (command == "LAMP") return state.lamps;
    if (command == "ERST") return state.troubles;
    if (command == "INPT") return state.input;
    if (command == "NAME") return state.name;
    if (command == "INF1") return state.maker;
    if (command == "INF2") return state.model;
    if (command == "CLSS") return state.protocolClass;
    if (command == "SNUM") return state.serial;
    if (command == "INNM") return state.inputName;
    if (command == "IRES") return state.signal;
    if (command == "RRES") return state.own;
    if (command == "FILT") return state.filter;
    if (command == "FREZ") return state.frozen;
    return {};
  }

  QByteArray power() {
    if (state.power != "2" && state.power != "3") return state.power;
    if (++looks_ > state.looksUntilWarm) state.power = state.power == "3" ? "1" : "0";
    return state.power;
  }

  QByteArray order(const QByteArray& parameter) {
    if (parameter != "0" && parameter != "1") return "ERR2";
    if (state.power == "2" || state.power == "3") return "ERR3";
    if (fault == ProjectorFault::saysOnStaysOff) return "OK";
    looks_ = 0;
    if (parameter == "1" && state.power == "0") state.power = "3";
    if (parameter == "0" && state.power == "1") state.power = "2";
    return "OK";
  }

  QByteArray mute(const QByteArray& parameter) {
    if (fault == ProjectorFault::noShutter) return "ERR1";
    if (fault == ProjectorFault::pictureWithSound && parameter.startsWith('1')) return "ERR2";
    if (state.power != "1") return "ERR3";
    if (fault != ProjectorFault::shutterSaysOk)
      state.shutter = parameter.endsWith('1') ? parameter : QByteArray("30");
    return "OK";
  }

  QTcpServer* server_ = nullptr;
  int looks_ = 0;
};

FakeProjector::FakeProjector(FakeProjectorState state, ProjectorFault fault, quint16 port)
    : machine_(std::make_unique<Machine>(std::move(state), fault)) {
  machine_->moveToThread(&thread_);
  thread_.start();
  QMetaObject::invokeMethod(
      machine_.get(), [this, port] { machine_->listen(port); }, Qt::BlockingQueuedConnection);
}

FakeProjector::~FakeProjector() {
  QMetaObject::invokeMethod(
      machine_.get(), [this] { qDeleteAll(machine_->children()); }, Qt::BlockingQueuedConnection);
  thread_.quit();
  thread_.wait();
}

pjlink::Address FakeProjector::address() const {
  const std::lock_guard lock(machine_->guard);
  return {"127.0.0.1", machine_->port, machine_->state.password.toStdString()};
}

FakeProjectorState FakeProjector::state() const {
  const std::lock_guard lock(machine_->guard);
  return machine_->state;
}

void FakeProjector::change(const std::function<void(FakeProjectorState&)>& how) {
  const std::lock_guard lock(machine_->guard);
  how(machine_->state);
}

void FakeProjector::setFault(ProjectorFault fault) {
  const std::lock_guard lock(machine_->guard);
  machine_->fault = fault;
}

void FakeProjector::setMangle(std::function<QByteArray(const QByteArray&)> mangle) {
  const std::lock_guard lock(machine_->guard);
  machine_->mangle = std::move(mangle);
}

QStringList FakeProjector::orders() const {
  const std::lock_guard lock(machine_->guard);
  return machine_->orders;
}

int FakeProjector::connections() const {
  const std::lock_guard lock(machine_->guard);
  return machine_->connections;
}

void FakeProjector::beFound() {
  QMetaObject::invokeMethod(machine_.get(), [this] { machine_->beFound(); }, Qt::BlockingQueuedConnection);
}

}  // namespace relucent::test
