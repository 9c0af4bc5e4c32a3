// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "relucent/pjlink/address.h"
#include "relucent/pjlink/protocol.h"
#include "relucent/rehearsal/loopback_server.h"

namespace relucent::rehearsal {

/// How long its lamp takes.
struct ProjectorTimes {
  std::chrono::milliseconds warmUp{400};  // with `haste`, 48 s
  std::chrono::milliseconds coolDown{300};
};

/// A projector with PJLink (class 1) on the loopback network: it warms up, cools down, keeps its port, and
/// can be as troublesome as one that hangs under a ceiling. Begins in standby. Safe to use from any thread.
class SimulatedProjector {
 public:
  using Clock = std::chrono::steady_clock;

  /// Throws: as LoopbackServer.
  explicit SimulatedProjector(ProjectorTimes times = {});

  pjlink::Address address() const { return {"127.0.0.1", port_, {}}; }
  pjlink::Power power();
  /// The mains fail: it is dark at once, and in standby when they are back.
  void cutPower();
  /// Off the network, with its lamp as it is.
  void vanish();
  /// Throws: as LoopbackServer.
  void comeBack();
  /// Says OK to every order and does nothing, or does what it says.
  void setObeys(bool obeys);
  /// As it tells them.
  void setLampHours(int hours);
  /// How often its lamp was lit by an order.
  int timesLit() const;

  /// What it answers to a line such as "%1POWR ?", without the carriage return; empty: nothing.
  std::string answerTo(std::string_view line, Clock::time_point now);

 private:
  /// Where its lamp has got to.
  void pass(Clock::time_point now);
  std::string order(std::string_view parameter, Clock::time_point now);
  void serve(Visitor& visitor);

  ProjectorTimes times_;
  mutable std::mutex guard_;
  pjlink::Power power_ = pjlink::Power::off;
  Clock::time_point until_{};  // of warming and cooling
  bool isShut_ = false, obeys_ = true;
  int lampHours_ = 0, timesLit_ = 0;
  int port_ = 0;
  std::unique_ptr<LoopbackServer>
      server_;  // nullptr: it is off the network. Last: its threads use the others
};

}  // namespace relucent::rehearsal
