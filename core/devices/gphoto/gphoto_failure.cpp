// SPDX-License-Identifier: MIT
#include "relucent/devices/gphoto/gphoto_failure.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <initializer_list>

#include "relucent/base/lowered.h"
#include "relucent/base/message.h"

namespace relucent::devices {
namespace {

bool speaksOf(const GphotoFailure& failure, std::initializer_list<std::string_view> words) {
  const std::string said = lowered(failure.what());
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return said.find(word) != std::string::npos; });
}

}  // namespace

std::optional<int> batteryPercent(std::string_view word) {
  const std::string text = lowered(word);
  int percent = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), percent);
  const bool isNumber = error == std::errc() && (end == text.data() + text.size() || *end == '%');
  // "0" to "4" without a sign are bars of some cameras.
  if (isNumber && text.ends_with('%')) return std::clamp(percent, 0, 100);
  if (isNumber && percent > 4) return std::min(percent, 100);
  if (text == "low" || text == "critical" || text == "exhausted" || text == "empty") return 5;
  return std::nullopt;
}

CameraLost lostByEmptyBattery(int percent) {
  return CameraLost(
      RELUCENT_MESSAGE("device.battery-empty",
                       "the camera's battery seems to be empty ({} % when it was last asked)")
          .with(as::share(percent / 100.0)),
      RELUCENT_MESSAGE(
          "device.charge-or-change-battery",
          "charge or change the battery, or better, use a mains adapter, and switch the camera on again"));
}

CameraLost lostByFullCard() {
  return CameraLost(RELUCENT_MESSAGE("device.card-full",
                                     "the camera has no room left for a photograph: its memory card is full"),
                    RELUCENT_MESSAGE("device.change-or-empty-card", "change or empty the memory card"));
}

CameraLost lostBy(const GphotoFailure& failure, const GphotoCondition& condition) {
  const bool hasEmptyBattery = condition.battery && *condition.battery <= emptyBattery;
  switch (failure.fault()) {
    case GphotoFault::claimed:
      return CameraLost(RELUCENT_MESSAGE("device.held-by-desktop",
                                         "another program is using the camera, usually the desktop, which "
                                         "mounts it like a memory stick"),
                        RELUCENT_MESSAGE("device.release-from-desktop",
                                         "make the desktop release it with `gio mount -s gphoto2` (or eject "
                                         "it in the file manager) and close photo programs"));
    case GphotoFault::full:
      return lostByFullCard();
    case GphotoFault::busy:
      return CameraLost(RELUCENT_MESSAGE("device.camera-stays-busy", "the camera stays busy"),
                        RELUCENT_MESSAGE("device.close-menus-and-live-view",
                                         "close its menus and its playback, and leave live view"));
    case GphotoFault::absent:
    case GphotoFault::silent:
      if (hasEmptyBattery) return lostByEmptyBattery(*condition.battery);
      if (failure.fault() == GphotoFault::silent && condition.isListed)
        return CameraLost(RELUCENT_MESSAGE("device.camera-asleep",
                                           "the camera is there but does not answer, it may be asleep"),
                          RELUCENT_MESSAGE("device.wake-camera",
                                           "press its shutter button half way or switch it off and on, and "
                                           "disable its automatic power-off"));
      return CameraLost(
          RELUCENT_MESSAGE("device.camera-gone",
                           "the camera has been unplugged or switched off, or has fallen asleep"),
          RELUCENT_MESSAGE("device.switch-on-and-keep-awake",
                           "check its cable, switch it on and disable its automatic power-off"));
    case GphotoFault::refused:
      break;
  }
  if (speaksOf(failure, {"store full", "card full", "no space", "memory full"})) return lostByFullCard();
  if (speaksOf(failure, {"battery"})) return lostByEmptyBattery(condition.battery.value_or(0));
  if (speaksOf(failure, {"focus"}))
    return CameraLost(
        RELUCENT_MESSAGE("device.no-focus", "the camera could not focus and took no photograph ({})")
            .with(failure.what()),
        RELUCENT_MESSAGE("device.switch-to-manual-focus", "switch its lens to manual focus"));
  return CameraLost(
      RELUCENT_MESSAGE("device.request-refused", "the camera refused what it was asked for ({})")
          .with(failure.what()),
      RELUCENT_MESSAGE("device.close-menus-and-restart", "close its menus, and switch it off and on"));
}

}  // namespace relucent::devices
