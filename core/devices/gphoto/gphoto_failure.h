// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "relucent/devices/camera_driver.h"
#include "relucent/devices/gphoto/gphoto_port.h"

namespace relucent::devices {

/// What is left in a battery, by the camera's word for it: "75%", "Low", "Full". Per cent; none: it does not
/// say.
std::optional<int> batteryPercent(std::string_view word);
/// At or below this a camera that stops has an empty battery.
inline constexpr int emptyBattery = 10;

/// What is known of a camera when something fails.
struct GphotoCondition {
  bool isListed = true;          // it is still plugged in and switched on
  std::optional<int> battery{};  // per cent, when it was last asked
};

/// A failure in a sentence, and a sentence that says what to do. All of them mend when somebody does it, so
/// that a measurement waits and goes on.
CameraLost lostBy(const GphotoFailure& failure, const GphotoCondition& condition);
CameraLost lostByEmptyBattery(int percent);
CameraLost lostByFullCard();

/// Does `action`, again and again while the camera is busy (writing the photograph before), up to some
/// seconds. Throws: GphotoFailure.
template <typename Action>
auto retryWhileBusy(GphotoPort& port, const Action& action) {
  using namespace std::chrono_literals;
  const std::chrono::microseconds deadline = port.now() + 10s;
  for (;;) {
    try {
      return action();
    } catch (const GphotoFailure& failure) {
      if (failure.fault() != GphotoFault::busy || port.now() >= deadline) throw;
    }
    port.wait(100ms);
  }
}

}  // namespace relucent::devices
