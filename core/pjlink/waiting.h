// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

#include "relucent/base/progress.h"

namespace relucent::pjlink {

/// How time passes; a test's passes at once.
struct Waiting {
  using Time = std::chrono::steady_clock::time_point;
  std::function<Time()> now = std::chrono::steady_clock::now;
  std::function<void(std::chrono::milliseconds)> sleep = [](std::chrono::milliseconds time) {
    std::this_thread::sleep_for(time);
  };

  /// Asks for cancellation ten times a second. Throws: Cancelled.
  void pause(std::chrono::milliseconds time, const Progress& progress) const {
    constexpr std::chrono::milliseconds slice{100};
    for (const Time end = now() + time; now() < end;) {
      progress.checkpoint();
      sleep(std::min(slice, std::chrono::ceil<std::chrono::milliseconds>(end - now())));
    }
    progress.checkpoint();
  }
};

}  // namespace relucent::pjlink
