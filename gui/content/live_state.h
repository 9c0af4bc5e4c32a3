// SPDX-License-Identifier: MIT
#pragma once

#include <QSize>
#include <QString>
#include <cstdint>
#include <optional>

#include "relucent/base/message.h"

namespace relucent::gui {

/// How a live picture that may be lost and come back is doing.
struct LiveState {
  enum class Phase {
    connecting,
    asking,  // whoever sits before the desktop is to choose in its dialog what is shown
    playing,
    lost
  };
  std::uint64_t opening = 0;  // differs between two openings of the same address
  QString address;            // for people
  Phase phase = Phase::connecting;
  Message problem{};        // of the last loss: what is wrong, and what to do; empty: nothing has been
  bool turnsBlack = false;  // while it is lost; else its last picture stays
  int losses = 0;           // since it was opened; failed connections after one are no further losses
  QSize size{};             // of its pictures; empty: none yet
  /// From the sender's clock to the arrival here, where the stream tells that clock's time.
  std::optional<double> senderSeconds{};

  bool operator==(const LiveState&) const = default;
};

}  // namespace relucent::gui
