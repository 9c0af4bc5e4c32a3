// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/progress.h"
#include "relucent/platform/interruption_signals.h"

namespace relucent::cli {

/// Turns Ctrl-C and the request to terminate into a StopRequest while it lives: the first asks the work to
/// cancel at its next checkpoint, the second ends the program at once with exit status 130 (what is on
/// disk is whole at every instant). One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  StopRequest& stop() { return stop_; }

 private:
  StopRequest stop_;
  platform::InterruptionSignals signals_;
};

}  // namespace relucent::cli
