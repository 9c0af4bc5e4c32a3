// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/devices/temporary_folder.h"
#include "relucent/rig/rig.h"

namespace relucent::devices {

struct CommandProjectorSettings {
  /// For /bin/sh; {image} becomes the path of a PNG of drive values, quoted where that is needed. The command
  /// returns when the picture is out of the projector, and may leave a viewer running in the background.
  std::string command;
  Size size;
  int bits = 8;                              // of the PNG: 8 or 16
  std::chrono::milliseconds timeout{60000};  // for one picture
  int attempts = 2;                          // at one picture
  std::string name = "projector command";
};
std::vector<Message> problems(const CommandProjectorSettings& settings);
/// Of the command alone: it is empty, or {image} is not in it.
std::vector<Message> problemsOfProjectorCommand(const std::string& command);

/// A projector behind an external program.
class CommandProjector : public rig::Projector {
 public:
  /// Throws: std::logic_error if problems(settings) finds any; Error{usage} as requireConsent(); Error{disk}.
  explicit CommandProjector(CommandProjectorSettings settings);

  std::string name() const override { return settings_.name; }
  Size size() const override { return settings_.size; }
  int bits() const override { return settings_.bits; }
  /// Throws: Error{device} with the command's last words if it fails or takes too long every time;
  /// Error{disk}.
  void show(const image::Image& encodedDrive) override;

 private:
  CommandProjectorSettings settings_;
  TemporaryFolder folder_;
};

}  // namespace relucent::devices
