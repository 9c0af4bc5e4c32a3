// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <memory>

namespace relucent {

/// Whether the desktop's displays are awake. A display that was put to sleep is still a screen of the
/// desktop, and whatever is shown on it is told to have been shown. The X server puts all of them to sleep
/// together: by DPMS, which takes their signal away, or behind its screen saver, a black picture. Either
/// tells of itself, so that a sleep between two questions is noticed too. Elsewhere (Wayland, no desktop)
/// nobody can be asked. Source: X Display Power Management Signaling (DPMS) Extension, X Screen Saver
/// Extension 1.1.
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
  /// Whether the displays are asleep, or have been since this was asked last.
  bool hasSlept();
  /// Asks for light. Projectors need some seconds more until they have found the signal again.
  void wake();
  /// As long as this lives the X server puts no display to sleep on its own account; whoever wants to still
  /// can. It forgets that by itself if the program dies.
  void keepAwake();

 private:
  struct Server;
  std::unique_ptr<Server> server_;  // nullptr: nobody to ask
};

}  // namespace relucent
