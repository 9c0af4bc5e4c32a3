// SPDX-License-Identifier: MIT
#include "cli/interruption.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>

#include "base/error.h"

namespace relucent {
namespace {

constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};
std::array<struct sigaction, signals.size()> before;
std::atomic<StopRequest*> asked{nullptr};

void interrupt(int) {
  StopRequest* stop = asked.load();
  if (stop == nullptr || stop->asked() == StopRequest::Kind::cancel) ::_exit(130);
  stop->ask(StopRequest::Kind::cancel);
}

}  // namespace

Interruption::Interruption() {
  require(asked.exchange(&stop_) == nullptr, "interruptions are handled already");
  struct sigaction action {};
  action.sa_handler = interrupt;
  action.sa_flags = SA_RESTART;  // files that are being written are written to the end
  ::sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &action, &before[i]);
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &before[i], nullptr);
  asked = nullptr;
}

}  // namespace relucent
