// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/pjlink/protocol.h"
#include "relucent/pjlink/session.h"

namespace relucent::pjlink {

/// What a projector says of itself. None and empty: it does not say.
struct Report {
  int protocolClass = 1;
  std::string name, maker, model, serial;  // UTF-8 without control characters
  std::optional<Power> power;
  std::optional<Shutter> shutter;
  std::vector<Lamp> lamps;
  std::vector<Trouble> troubles;
  std::string input, inputName;   // "31", "HDMI 1"
  std::optional<Signal> signal;   // at that input
  std::optional<Size> ownPixels;  // that it recommends: those of its panel
  std::optional<int> filterHours;
  bool isFrozen = false;
  std::vector<std::string> unclear;  // commands to which it answered something else
};

/// Asks for all of it. In standby most projectors tell little.  Throws: as Session::ask().
Report look(Session& session);

/// Whether a projector does as it was told.
enum class Obedience { done, notNow, cannot };
/// `done` is what it says: a look afterwards tells whether it is true.
/// Throws: as Session::ask(); Error{device} if it reports a failure of its own.
Obedience switchPower(Session& session, bool on);
/// Closes and opens the shutter of the picture; the sound stays as it is.
Obedience closeShutter(Session& session, bool closed);

/// A sentence for all that is wrong with it, for people. `label`: what the projector is called.
/// `sent`: the pixels of the picture that it is sent; none: whatever its own.
std::vector<Message> troublesOf(const Report& report, const std::string& label);
/// And for settings that spoil the picture: another input than its pixels, a frozen picture.
std::vector<Message> harmfulSettings(const Report& report, const std::string& label,
                                     const std::optional<Size>& sent);

}  // namespace relucent::pjlink
