// SPDX-License-Identifier: MIT
#pragma once

namespace relucent::platform {

/// Has a function called, while it lives, whenever the program is asked to end: Ctrl-C in its terminal, the
/// terminal is closed, the system ends. What was set before comes back. One at a time.
class InterruptionSignals {
 public:
  /// `handler` runs in between any two instructions of the program: it may set atomic variables and end the
  /// program, and nothing else.
  explicit InterruptionSignals(void (*handler)());
  ~InterruptionSignals();
  InterruptionSignals(const InterruptionSignals&) = delete;
  InterruptionSignals& operator=(const InterruptionSignals&) = delete;
};

}  // namespace relucent::platform
