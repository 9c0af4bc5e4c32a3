// SPDX-License-Identifier: MIT
#pragma once

#include <QDBusUnixFileDescriptor>
#include <QStringList>
#include <QtGlobal>

#include "desktop/display_power.h"

namespace relucent::gui {

/// During its lifetime the computer does not suspend, and neither desktop nor X server put a display to sleep
/// or start a screen saver by themselves.
class Awake {
 public:
  /// `why`: the reason that the desktop shows to the user.
  explicit Awake(const QString& why);
  ~Awake();
  Awake(const Awake&) = delete;
  Awake& operator=(const Awake&) = delete;

  /// Wakes displays that are asleep nevertheless, or have been since the last call; returns whether there
  /// were any. They may have slept before, on a user's request, or because the desktop offers no inhibition.
  bool wakeDisplays();
  /// Failures to keep something awake, one sentence each; empty: none.
  const QStringList& problems() const { return problems_; }

 private:
  DisplayPower displays_;
  QDBusUnixFileDescriptor sleep_;  // keeps the system awake until it is closed
  quint32 screenSaver_ = 0;
  bool screenSaverInhibited_ = false;
  QStringList problems_;
};

}  // namespace relucent::gui
