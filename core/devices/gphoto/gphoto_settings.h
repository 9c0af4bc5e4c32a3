// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "relucent/devices/gphoto/gphoto_port.h"

namespace relucent::devices {

/// A camera's settings, borrowed: what is changed through this is put back by restore().
class BorrowedSettings {
 public:
  /// `port` has to outlive this.
  explicit BorrowedSettings(GphotoPort& port) : port_(port) {}

  /// Throws: GphotoFailure, as all here but restore().
  std::optional<GphotoSetting> get(const std::string& setting) const;
  /// The first of these settings that the camera has, with its name.
  std::optional<std::pair<std::string, GphotoSetting>> firstOf(
      std::initializer_list<const char*> settings) const;
  /// Asks for a value; whether the camera has it afterwards. Does nothing where it has it already.
  bool set(const std::string& setting, const std::string& value);

  /// Puts everything back, the latest change first. If the camera is gone, what is left stays to be put back
  /// next time.
  void restore() noexcept;
  /// Another camera has come: there is nothing to be put back.
  void forget() { originals_.clear(); }

 private:
  GphotoPort& port_;
  std::vector<std::pair<std::string, std::string>> originals_;  // setting, value; in order of first change
};

}  // namespace relucent::devices
