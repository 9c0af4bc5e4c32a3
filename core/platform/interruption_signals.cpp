// SPDX-License-Identifier: MIT
#include "relucent/platform/interruption_signals.h"

#include <signal.h>

#include <array>
#include <atomic>

namespace relucent::platform {
namespace {

constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};
std::array<struct sigaction, signals.size()> before;
std::atomic<void (*)()> called{nullptr};

void interrupt(int) {
  if (auto* handler = called.load()) handler();
}

}  // namespace

InterruptionSignals::InterruptionSignals(void (*handler)()) {
  called = handler;
  struct sigaction action{};
  action.sa_handler = interrupt;
  action.sa_flags = SA_RESTART;  // files that are being written are written to the end
  ::sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &action, &before[i]);
}

InterruptionSignals::~InterruptionSignals() {
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &before[i], nullptr);
  called = nullptr;
}

}  // namespace relucent::platform
