// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/devices/temporary_folder.h"
#include "relucent/rig/rig.h"

namespace relucent::devices {

struct CommandCameraSettings {
  /// For /bin/sh. {exposure} becomes the exposure time in seconds, {output} the path of the file to write,
  /// {shot} a name for the photograph ("acquisition-17-0"), quoted where that is needed.
  std::string command;
  std::optional<Size> size;       // none: the size of a first photograph, taken when the camera is made
  std::string extension = "exr";  // of {output}; the program may write another one under the same name
  rig::ExposureRange exposures{1e-3, 4.0};
  std::chrono::milliseconds timeout{60000};  // for one photograph, on top of its exposure time
  int attempts = 2;                          // at one photograph: cables and cameras have hiccups
  std::string name = "camera command";
};
std::vector<Message> problems(const CommandCameraSettings& settings);
/// Of the command alone: it is empty, or one of {exposure} and {output} is not in it.
std::vector<Message> problemsOfCameraCommand(const std::string& command);

/// A camera behind an external program. It writes float OpenEXR or TIFF (linear, full scale 1), 16-bit PNG or
/// TIFF, or 8-bit pictures; RawFrame::bits says which. Every photograph has a clean folder, so an old file is
/// never taken for a new one. The exposure time is reported as it was asked for.
class CommandCamera : public rig::Camera {
 public:
  /// Of its addresses, "command:./photograph {exposure} {output}".
  static constexpr const char* kind = "command";

  /// Throws: std::logic_error if problems(settings) finds any; Error{usage} as requireConsent(); as capture()
  /// if a first photograph is taken.
  explicit CommandCamera(CommandCameraSettings settings);

  std::string name() const override { return settings_.name; }
  Size size() const override { return size_; }
  rig::ExposureRange exposures() const override { return settings_.exposures; }
  /// As often as the settings say before it throws: Error{device} if the command fails, takes too long, or
  /// writes no file or one of another size; Error{format} if the file cannot be read, Error{input} if it
  /// holds NaN or infinities.
  rig::RawFrame capture(const rig::CaptureRequest& request) override;

 private:
  rig::RawFrame photograph(const rig::CaptureRequest& request);
  rig::RawFrame checkedPhotograph(const rig::CaptureRequest& request);

  CommandCameraSettings settings_;
  TemporaryFolder folder_;
  Size size_;
};

}  // namespace relucent::devices
