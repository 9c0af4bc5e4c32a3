// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/base/progress.h"
#include "relucent/pjlink/projector.h"

namespace relucent::pjlink {

struct KeeperSettings {
  std::string label;           // what people call the projector: "1", "left"
  std::optional<Size> sent{};  // pixels of the picture that it is sent
  bool switchesPower = false;  // on while it is wanted, off otherwise; else it is only watched
  bool closesShutter = false;  // while black is wanted
  std::chrono::milliseconds interval{30'000};  // between two looks ...
  std::chrono::milliseconds soon{3'000};       // ... and while it does not do yet what is wanted
  std::chrono::milliseconds longestPause{
      300'000};                              // while it does not answer: doubled from `soon` up to here
  std::chrono::milliseconds obeys{240'000};  // after which a projector that does not is told of
  Patience patience{};
};

/// What a show wants of a projector.
struct Wanted {
  bool on = true;
  bool black = false;
  bool operator==(const Wanted&) const = default;
};

/// What came of looking after it once.
struct Kept {
  std::optional<Report> report{};     // none: it does not answer
  Message problem{};                  // why not; empty: it does
  std::vector<Message> told{};        // for the log: what was done
  std::vector<Message> warned{};      // what somebody should see to, each once while it lasts
  std::chrono::milliseconds pause{};  // until it should be looked after again
};

/// Looks after one projector during a show: switches it on and off, closes its shutter, and tells what is
/// wrong with it. What does not answer is asked again, less and less often; nothing here is a reason to end a
/// show.
class Keeper {
 public:
  using Time = std::chrono::steady_clock::time_point;

  Keeper(Address address, KeeperSettings settings);

  /// Blocks as a Session does. Throws: Cancelled.
  Kept keep(const Wanted& wanted, Time now, const Progress& progress);

 private:
  /// Told once for as long as it is said again at each look.
  void warnOnce(Kept& kept, Message sentence);
  /// Each tells whether all is as wanted.
  bool keepPower(Session& session, const Wanted& wanted, Time now, Kept& kept);
  bool keepShutter(Session& session, const Wanted& wanted, Kept& kept);
  void missed(Kept& kept, Message why);

  Address address_;
  KeeperSettings settings_;
  std::set<std::string> standing_, said_;  // sentences of the last look, and of this one
  std::optional<Time> differsSince_;       // in its power from what is wanted
  std::optional<bool> toldPower_;          // what the log was told last
  bool hasShutter_ = true;
  int failures_ = 0;  // in a row
};

}  // namespace relucent::pjlink
