// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <memory>

namespace relucent::gui {

/// Whether the desktop's displays are awake. A sleeping display is still a screen of the desktop, and showing
/// pictures on it appears to succeed. The X server puts all displays to sleep together: by DPMS, which
/// switches off their signal, or by its screen saver, a black picture. Both send events, so that a sleep
/// between two calls is noticed too. Other systems (Wayland, no desktop) offer no query. Source: X Display
/// Power Management Signaling (DPMS) Extension, X Screen Saver Extension 1.1.
class DisplayPower {
 public:
  enum class State { awake, asleep, unknown };

  DisplayPower();
  ~DisplayPower();
  DisplayPower(const DisplayPower&) = delete;
  DisplayPower& operator=(const DisplayPower&) = delete;

  State state() const;
  /// Why the state is unknown, a sentence; empty: it is known.
  QString problem() const;
  /// Whether the displays are asleep, or have been since the last call.
  bool hasSlept();
  /// Wakes the displays. Projectors need some more seconds to find the signal again.
  void wake();
  /// During its lifetime the X server puts no display to sleep by itself; users still can. The X server
  /// releases this if the program dies.
  void keepAwake();

 private:
  struct Server;
  std::unique_ptr<Server> server_;  // nullptr: no X server
};

}  // namespace relucent::gui
