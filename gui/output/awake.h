// SPDX-License-Identifier: MIT
#pragma once

#include <QDBusUnixFileDescriptor>
#include <QStringList>
#include <QtGlobal>

namespace relucent {

/// As long as it lives the computer does not go to sleep, and the desktop shows no screen saver.
class Awake {
 public:
  /// `why`: what the desktop tells a user who asks what keeps it awake.
  explicit Awake(const QString& why);
  ~Awake();
  Awake(const Awake&) = delete;
  Awake& operator=(const Awake&) = delete;

  /// What could not be kept awake, one sentence each; empty: everything.
  const QStringList& problems() const { return problems_; }

 private:
  QDBusUnixFileDescriptor sleep_;  // the system stays awake until it is closed
  quint32 screenSaver_ = 0;
  bool screenSaverInhibited_ = false;
  QStringList problems_;
};

}  // namespace relucent
