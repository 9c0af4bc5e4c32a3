// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <string_view>

#include "relucent/base/progress.h"
#include "relucent/pjlink/address.h"
#include "relucent/pjlink/protocol.h"

namespace relucent::pjlink {

/// How long a projector is waited for, whatever it sends meanwhile.
struct Patience {
  std::chrono::milliseconds connecting{4000};  // its name found, connected and greeted
  std::chrono::milliseconds answering{4000};   // a whole answer
};

/// A connection to a projector. Blocks, though never longer than its patience; asks `progress` for
/// cancellation ten times a second.
class Session {
 public:
  /// Connects.
  /// Throws: Error{device} if the projector does not answer, is no PJLink, or wants another password;
  /// Cancelled.
  Session(const Address& address, const Patience& patience, const Progress& progress);
  ~Session();

  /// What the projector answers to a command; none: something that is no answer to it.
  ///   ask("POWR", "?")
  /// Throws: Error{device} if it closes, is silent, or wants another password; Cancelled.
  std::optional<Answer> ask(std::string_view command, std::string_view parameter, int protocolClass = 1);

  const Address& address() const { return address_; }

 private:
  class Line;
  Address address_;
  Patience patience_;
  const Progress& progress_;
  std::unique_ptr<Line> line_;
  std::string digest_;  // before the first command
};

}  // namespace relucent::pjlink
