// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/devices/camera_driver.h"

namespace relucent::devices {

struct DrivenCameraSettings {
  std::chrono::milliseconds timeout{2000};  // for a photograph, on top of its exposure time
  int attempts = 5;                         // at one photograph
  /// How long a camera is tried at first: what a program that crashed held is free after some seconds.
  std::chrono::milliseconds connectFor{4000};
  std::chrono::milliseconds reconnectFor{30000};  // how long a camera that is gone is waited for, ...
  std::chrono::milliseconds reconnectPause{500};  // ... and how often it is looked for
  int skipAfterChange = 0;  // frames after a new exposure time that may still have the old one
  /// No frame can arrive sooner than its exposure time after it was begun. False for simulated cameras that
  /// do not wait while they expose.
  bool exposureTakesTime = true;
};
std::vector<Message> problems(const DrivenCameraSettings& settings);

/// Any camera that a driver speaks to, with the patience and the mistrust that real cameras need:
/// - Exposure times are believed as they are read back, and both ends of the range are tried when the camera
///   is connected. A time that is off by more than half is refused.
/// - A frame counts only if it arrived late enough to have been exposed wholly after it was asked for, and
///   if its number is not that of the frame before. Older ones are dropped.
/// - A frame with parts missing, of another size, or that does not come is asked for again; from the second
///   time on the camera is connected again.
/// - A camera that is gone is looked for again and set up as before; the photograph is then taken again.
/// - Where only a part of the photograph is looked at, the camera delivers that part, if it can, and the rest
///   is 0.
class DrivenCamera : public rig::Camera {
 public:
  /// Throws: std::logic_error if problems(settings) finds any; Error{device} if there is no such camera.
  explicit DrivenCamera(std::unique_ptr<CameraDriver> driver, DrivenCameraSettings settings = {});
  ~DrivenCamera() override;

  std::string name() const override { return driver_->name(); }
  Size size() const override { return traits_.size; }
  /// As the camera kept to when both ends were tried.
  rig::ExposureRange exposures() const override { return traits_.exposures; }
  /// Throws: Error{device} with the last of the reasons after so many attempts, or when the camera stays
  /// away.
  rig::RawFrame capture(const rig::CaptureRequest& request) override;

  const CameraTraits& traits() const { return traits_; }
  /// Photographs that had to be taken again, and times that the camera was gone.
  int repeats() const { return repeats_; }
  int reconnections() const { return reconnections_; }

 private:
  CameraTraits connected();
  void reconnect();
  bool restarted();
  void probe(CameraTraits& traits);
  double expose(double seconds);
  void look(const std::optional<rig::PicturePart>& part);
  rig::PicturePart all() const { return {{0, 0}, traits_.size}; }
  DriverFrame freshFrame(double seconds);
  bool isStale(const DriverFrame& frame, std::chrono::microseconds asked, double seconds) const;

  std::unique_ptr<CameraDriver> driver_;
  DrivenCameraSettings settings_;
  CameraTraits traits_;
  bool isConnected_ = false;
  double held_ = 0.0;                    // exposure time of the camera; 0: not known
  rig::PicturePart asked_, delivered_;   // parts of the photograph
  int toSkip_ = 0;                       // frames that may still have an older one
  std::optional<std::uint64_t> lastId_;  // of a frame that was used, since the camera was connected
  int repeats_ = 0;
  int reconnections_ = 0;
};

}  // namespace relucent::devices
