// SPDX-License-Identifier: MIT
#include "desktop/screen_cast_session.h"

#include <QCoreApplication>
#include <QDBusArgument>
#include <QDBusError>
#include <QDBusMessage>
#include <QDBusObjectPath>
#include <QDBusPendingReply>
#include <QDBusVariant>
#include <QThread>
#include <QUuid>

#include "desktop/cast_failure.h"
#include "relucent/base/progress.h"

namespace relucent::gui {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* service = "org.freedesktop.portal.Desktop";
constexpr const char* path = "/org/freedesktop/portal/desktop";
constexpr std::chrono::milliseconds moment{10};
constexpr std::chrono::milliseconds restoring{1'000};  // without a question it takes less
// The portal's words.
constexpr uint monitors = 1, windows = 2, untilRevoked = 2, firstVersionWithTokens = 4;
constexpr uint wasRefused = 1;

QString uniqueWord() {
  return "relucent_" + QUuid::createUuid().toString(QUuid::Id128);
}

/// It has answered a call by an error of its own.
class PortalRefusal : public Error {
 public:
  explicit PortalRefusal(const QString& reason) : Error(castPortalFailed(reason)) {}
};

[[noreturn]] void fail(const QDBusMessage& answer, std::chrono::milliseconds waited) {
  switch (QDBusError(answer).type()) {
    case QDBusError::ServiceUnknown:
    case QDBusError::UnknownInterface:
    case QDBusError::UnknownMethod:
    case QDBusError::UnknownObject:
    case QDBusError::UnknownProperty:
    case QDBusError::InvalidArgs:  // Qt's word for a property of an interface that is not there
    case QDBusError::Disconnected:
      throw castWithoutPortal();
    case QDBusError::NoReply:
    case QDBusError::Timeout:
    case QDBusError::TimedOut:
      throw castPortalSilent(waited);
    default:
      throw PortalRefusal(answer.errorMessage());
  }
}

/// Of an answer to Start: the first stream's node.
quint32 nodeIn(const QVariantMap& results) {
  const QVariant streams = results.value("streams");
  if (streams.userType() != qMetaTypeId<QDBusArgument>()) throw castUnusable();
  const auto argument = streams.value<QDBusArgument>();
  if (argument.currentSignature() != "a(ua{sv})") throw castUnusable();
  argument.beginArray();
  if (argument.atEnd()) throw castUnusable();
  quint32 node = 0;
  argument.beginStructure();
  argument >> node;
  return node;
}

}  // namespace

ScreenCastSession::ScreenCastSession(const ScreenCastWish& wish, const ScreenCastVisitor& visitor)
    : wish_(wish),
      visitor_(visitor),
      name_(uniqueWord()),
      bus_(QDBusConnection::connectToBus(QDBusConnection::SessionBus, name_)) {
  try {
    if (!bus_.isConnected()) throw castWithoutPortal();
    bus_.connect("org.freedesktop.DBus", "/org/freedesktop/DBus", "org.freedesktop.DBus", "NameOwnerChanged",
                 {service}, QString(), this, SLOT(noteOwner(QString, QString, QString)));
    examine();
    begin();
    select();
    start();
  } catch (...) {
    QDBusConnection::disconnectFromBus(name_);
    throw;
  }
}

ScreenCastSession::~ScreenCastSession() {
  QDBusConnection::disconnectFromBus(name_);
}

QDBusUnixFileDescriptor ScreenCastSession::remote() {
  const QDBusMessage answer =
      answerTo("OpenPipeWireRemote", {QVariant::fromValue(QDBusObjectPath(session_)), QVariantMap()});
  if (answer.type() == QDBusMessage::ErrorMessage || answer.arguments().isEmpty())
    throw castWithoutPipeWire();
  auto descriptor = answer.arguments().constFirst().value<QDBusUnixFileDescriptor>();
  if (!descriptor.isValid()) throw castWithoutPipeWire();
  return descriptor;
}

bool ScreenCastSession::isClosed() {
  QCoreApplication::sendPostedEvents(this);
  return isClosed_ || !bus_.isConnected();
}

void ScreenCastSession::noteOwner(const QString&, const QString& before, const QString&) {
  // What it has begun goes with a portal; one that is only now started has begun nothing.
  if (!before.isEmpty()) isClosed_ = true;
}

void ScreenCastSession::respond(uint code, const QVariantMap& results) {
  isAnswered_ = true;
  code_ = code;
  results_ = results;
}

void ScreenCastSession::examine() {
  const uint given = property("AvailableSourceTypes");
  const bool hasWindows = (given & windows) != 0, hasScreens = (given & monitors) != 0;
  if (wish_.what == ScreenCastWish::What::window && !hasWindows && hasScreens) throw castWithoutWindows();
  if (!(wish_.what == ScreenCastWish::What::window ? hasWindows : hasScreens)) throw castWithoutPortal();
}

void ScreenCastSession::begin() {
  const QVariantMap results = asked("CreateSession", {}, {{"session_handle_token", name_}}, wish_.portal);
  // A string it is, by an old mistake of the portal's that its documentation keeps.
  const QVariant session = results.value("session_handle");
  session_ = session.userType() == qMetaTypeId<QDBusObjectPath>() ? session.value<QDBusObjectPath>().path()
                                                                  : session.toString();
  if (session_.isEmpty()) throw castPortalFailed("session_handle");
  bus_.connect(service, session_, "org.freedesktop.portal.Session", "Closed", this, SLOT(close()));
}

void ScreenCastSession::select() {
  QVariantMap options{{"types", wish_.what == ScreenCastWish::What::screen ? monitors : windows},
                      {"multiple", false}};
  if (property("version") >= firstVersionWithTokens) options["persist_mode"] = untilRevoked;
  const QVariantList session{QVariant::fromValue(QDBusObjectPath(session_))};
  if (options.contains("persist_mode") && !wish_.token.isEmpty()) {
    QVariantMap again = options;
    again["restore_token"] = wish_.token;
    try {
      asked("SelectSources", session, again, wish_.portal);
      return;
    } catch (const PortalRefusal&) {
      // What is no token of its own leads to the dialog, as one that it has forgotten does.
    }
  }
  asked("SelectSources", session, options, wish_.portal);
}

void ScreenCastSession::start() {
  const QVariantMap results =
      asked("Start", {QVariant::fromValue(QDBusObjectPath(session_)), QString()}, {}, wish_.dialog);
  token_ = results.value("restore_token").toString();
  node_ = nodeIn(results);
}

QVariantMap ScreenCastSession::asked(const QString& method, QVariantList arguments, QVariantMap options,
                                     std::chrono::milliseconds patience) {
  // Listened to before it can answer: the path is known from the connection's name and a word of one's own.
  const QString word = QString("%1_%2").arg(name_).arg(++requests_);
  const QString request =
      QString("%1/request/%2/%3").arg(path, bus_.baseService().mid(1).replace('.', '_'), word);
  const auto listen = [&](bool begins, const QString& to) {
    constexpr const char* interface = "org.freedesktop.portal.Request";
    return begins
               ? bus_.connect(service, to, interface, "Response", this, SLOT(respond(uint, QVariantMap)))
               : bus_.disconnect(service, to, interface, "Response", this, SLOT(respond(uint, QVariantMap)));
  };
  isAnswered_ = false;
  listen(true, request);
  options["handle_token"] = word;
  arguments.append(options);
  const QDBusMessage answer = answerTo(method, arguments);
  if (answer.type() == QDBusMessage::ErrorMessage) fail(answer, wish_.portal);

  const bool asksSomebody = method == "Start";
  bool isAsked = false;
  const Clock::time_point begin = Clock::now();
  while (!isAnswered_) {
    if (isClosed()) throw castEnded();
    const auto waited = Clock::now() - begin;
    if (patience.count() > 0 && waited > patience) {
      if (asksSomebody) throw castUnanswered(!wish_.token.isEmpty());
      throw castPortalSilent(patience);
    }
    if (asksSomebody && !isAsked && waited > restoring && visitor_.isAsked) {
      isAsked = true;
      visitor_.isAsked();
    }
    pause();
  }
  listen(false, request);
  if (code_ == wasRefused) throw castRefused();
  if (code_ != 0) throw castEnded();
  return std::exchange(results_, {});
}

QDBusMessage ScreenCastSession::answerTo(const QString& method, const QVariantList& arguments,
                                         const QString& interface) {
  QDBusMessage call = QDBusMessage::createMethodCall(service, path, interface, method);
  call.setArguments(arguments);
  const QDBusPendingCall pending = bus_.asyncCall(call, static_cast<int>(wish_.portal.count()));
  while (!pending.isFinished()) pause();
  return pending.reply();
}

uint ScreenCastSession::property(const QString& name) {
  const QDBusMessage answer =
      answerTo("Get", {"org.freedesktop.portal.ScreenCast", name}, "org.freedesktop.DBus.Properties");
  if (answer.type() == QDBusMessage::ErrorMessage) fail(answer, wish_.portal);
  return answer.arguments().value(0).value<QDBusVariant>().variant().toUInt();
}

void ScreenCastSession::pause() {
  if (visitor_.isUnwanted && visitor_.isUnwanted()) throw Cancelled();
  QThread::msleep(static_cast<unsigned long>(moment.count()));
  QCoreApplication::sendPostedEvents(this);
}

}  // namespace relucent::gui
