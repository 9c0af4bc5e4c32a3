// SPDX-License-Identifier: MIT
#pragma once

#include <QDBusUnixFileDescriptor>
#include <QStringList>
#include <QtGlobal>

#include "output/display_power.h"

namespace relucent {

/// As long as it lives the computer does not go to sleep, and neither desktop nor X server put a display to
/// sleep or show a screen saver on their own account.
class Awake {
 public:
  /// `why`: what the desktop tells a user who asks what keeps it awake.
  explicit Awake(const QString& why);
  ~Awake();
  Awake(const Awake&) = delete;
  Awake& operator=(const Awake&) = delete;

  /// Wakes displays that sleep nevertheless, or have slept since this was asked last: whether there were any.
  /// They slept already, somebody wished it, or the desktop could not be asked.
  bool wakeDisplays();
  /// What could not be kept awake, one sentence each; empty: everything.
  const QStringList& problems() const { return problems_; }

 private:
  DisplayPower displays_;
  QDBusUnixFileDescriptor sleep_;  // the system stays awake until it is closed
  quint32 screenSaver_ = 0;
  bool screenSaverInhibited_ = false;
  QStringList problems_;
};

}  // namespace relucent
