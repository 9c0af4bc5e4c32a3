// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/devices/sensor_frame.h"
#include "relucent/rig/rig.h"

namespace relucent::devices {

/// Nobody answers, or somebody else holds the camera. Met by what drives the driver: it connects again.
class CameraLost : public std::exception {
 public:
  /// `reason`: a sentence without a full stop. `advice`: one that says what to do; empty: look after its
  /// cable, its power and its address.
  explicit CameraLost(Message reason, Message advice = {})
      : reason_(std::move(reason)), advice_(std::move(advice)), line_(english(reason_)) {}
  const char* what() const noexcept override { return line_.c_str(); }
  const Message& reason() const { return reason_; }
  const Message& advice() const { return advice_; }

 private:
  Message reason_, advice_;
  std::string line_;
};

/// What a camera says of itself once it is connected.
struct CameraTraits {
  std::string model;               // "Aravis Fake GV01"
  Size size;                       // of photographs
  SensorFormat format;             // of frames
  rig::ExposureRange exposures;    // as the camera claims
  bool triggered = false;          // a frame comes when it is asked for; otherwise all the time
  double gain = 0.0;               // as read back, in the camera's own unit
  std::vector<Message> remarks{};  // sentences that its user should know
};

/// A frame as it arrived.
struct DriverFrame {
  SensorFrame frame;
  std::uint64_t id = 0;                 // the camera's number for it
  std::chrono::microseconds arrived{};  // when its first part came, on the driver's clock
  Message damage{};                     // why it cannot be used; empty: it is whole
};

/// A camera as a library drives it: the seam between what can be tested without any camera (driven_camera.h)
/// and what cannot. No retries, no judgement.
/// All but the destructor throw CameraLost when the camera is gone, and Error{device} for what trying again
/// does not mend.
class CameraDriver {
 public:
  virtual ~CameraDriver() = default;

  /// The address that it was made with, for errors.
  virtual std::string name() const = 0;
  /// Connects, switches everything automatic off and starts to listen for frames. Also after disconnect().
  virtual CameraTraits connect() = 0;
  virtual void disconnect() noexcept = 0;

  /// Asks for an exposure time; returns the one that the camera says it has now. Seconds.
  virtual double setExposure(double seconds) = 0;
  /// Asks for a part of the photograph; returns the one that frames hold from the next one on, which holds
  /// the part. None: frames hold all of it, whatever is asked for. After connect() they do.
  virtual std::optional<rig::PicturePart> look(const rig::PicturePart& /*part*/) { return std::nullopt; }
  /// Asks for a frame if the camera is triggered; otherwise nothing.
  virtual void trigger() = 0;
  /// The next frame, oldest first; none if none comes in time.
  virtual std::optional<DriverFrame> next(std::chrono::microseconds time) = 0;
  /// Gives up all frames that are under way: none of them comes from next() any more.
  virtual void restart() = 0;

  /// The clock that frames are stamped with.
  virtual std::chrono::microseconds now() const = 0;
  virtual void wait(std::chrono::microseconds time) = 0;
};

}  // namespace relucent::devices
