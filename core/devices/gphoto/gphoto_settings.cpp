// SPDX-License-Identifier: MIT
#include "relucent/devices/gphoto/gphoto_settings.h"

#include <algorithm>

#include "relucent/devices/gphoto/gphoto_failure.h"

namespace relucent::devices {

std::optional<GphotoSetting> BorrowedSettings::get(const std::string& setting) const {
  return retryWhileBusy(port_, [&] { return port_.get(setting); });
}

std::optional<std::pair<std::string, GphotoSetting>> BorrowedSettings::firstOf(
    std::initializer_list<const char*> settings) const {
  for (const char* name : settings)
    if (std::optional<GphotoSetting> setting = get(name))
      return std::pair(std::string(name), *std::move(setting));
  return std::nullopt;
}

bool BorrowedSettings::set(const std::string& setting, const std::string& value) {
  const std::optional<GphotoSetting> before = get(setting);
  if (!before) return false;
  if (before->value == value) return true;
  if (before->readOnly) return false;
  // Remembered before it is changed: a call that fails may have changed it all the same.
  const bool isKnown = std::any_of(originals_.begin(), originals_.end(),
                                   [&](const auto& original) { return original.first == setting; });
  if (!isKnown) originals_.emplace_back(setting, before->value);
  try {
    retryWhileBusy(port_, [&] { port_.set(setting, value); });
  } catch (const GphotoFailure& failure) {
    if (failure.fault() != GphotoFault::refused) throw;
    return false;
  }
  const std::optional<GphotoSetting> after = get(setting);
  return after && after->value == value;
}

void BorrowedSettings::restore() noexcept {
  while (!originals_.empty()) {
    const auto& [setting, value] = originals_.back();
    try {
      retryWhileBusy(port_, [&] { port_.set(setting, value); });
    } catch (const GphotoFailure& failure) {
      // What it refuses it will refuse again; the others may still go back.
      if (failure.fault() != GphotoFault::refused) return;
    }
    originals_.pop_back();
  }
}

}  // namespace relucent::devices
