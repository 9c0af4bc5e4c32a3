// SPDX-License-Identifier: MIT
#pragma once

#include <QDBusConnection>
#include <QDBusPendingCall>
#include <QDBusUnixFileDescriptor>
#include <QObject>
#include <QVariantMap>

#include "desktop/screen_cast_wish.h"

namespace relucent::gui {

/// A session of the ScreenCast portal: what is shown is agreed on with the desktop, and with whoever sits
/// before it. On a connection to the bus of its own, with which the session ends, and a dialog closes.
class ScreenCastSession : public QObject {
  Q_OBJECT

 public:
  /// Begins one, and waits until it is agreed on. Throws: as ScreenCast.
  ScreenCastSession(const ScreenCastWish& wish, const ScreenCastVisitor& visitor);
  ~ScreenCastSession() override;

  const QString& token() const { return token_; }
  quint32 node() const { return node_; }
  /// A connection to PipeWire that sees that node. Throws: Error{device}.
  QDBusUnixFileDescriptor remote();
  /// The desktop has ended it, or portal or bus are gone.
  bool isClosed();

 private Q_SLOTS:
  void respond(uint code, const QVariantMap& results);
  void close() { isClosed_ = true; }
  void noteOwner(const QString& name, const QString& before, const QString& now);

 private:
  void examine();
  void begin();
  void select();
  void start();
  /// Calls a method whose answer comes by a Request, and waits for that. `patience`: 0: without end.
  QVariantMap asked(const QString& method, QVariantList arguments, QVariantMap options,
                    std::chrono::milliseconds patience);
  QDBusMessage answerTo(const QString& method, const QVariantList& arguments,
                        const QString& interface = "org.freedesktop.portal.ScreenCast");
  uint property(const QString& name);
  /// Delivers what has come to this object, and waits a moment. Throws: Cancelled.
  void pause();

  const ScreenCastWish wish_;
  const ScreenCastVisitor visitor_;
  const QString name_;
  QDBusConnection bus_;
  QString session_, token_;
  quint32 node_ = 0;
  int requests_ = 0;
  bool isClosed_ = false, isAnswered_ = false;
  uint code_ = 0;
  QVariantMap results_;
};

}  // namespace relucent::gui
