// SPDX-License-Identifier: MIT
#include "relucent/cli/interruption.h"

#include <atomic>
#include <cstdlib>

#include "relucent/base/error.h"

namespace relucent::cli {
namespace {

std::atomic<StopRequest*> asked{nullptr};

void interrupt() {
  StopRequest* stop = asked.load();
  if (stop == nullptr || stop->asked() == StopRequest::Kind::cancel) std::_Exit(130);
  stop->ask(StopRequest::Kind::cancel);
}

/// Before the signals, which may come at once.
StopRequest& onlyOne(StopRequest& stop) {
  require(asked.exchange(&stop) == nullptr, "interruptions are handled already");
  return stop;
}

}  // namespace

Interruption::Interruption() : signals_((onlyOne(stop_), interrupt)) {}

Interruption::~Interruption() {
  asked = nullptr;
}

}  // namespace relucent::cli
