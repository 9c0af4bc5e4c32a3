// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/raster.h"

namespace relucent::devices {

/// Controls of a video device, in the units of Video4Linux.
enum class VideoControl {
  exposureMode,           // 1: manual, all else decides by itself
  exposure,               // 100 microseconds
  automaticWhiteBalance,  // 0: off
  automaticFocus,         // 0: off
  gain,
};

struct VideoFrame {
  Size size;
  std::vector<std::uint8_t> bgr;                      // interleaved
  std::optional<std::chrono::microseconds> captured;  // on the source's clock; none: the driver does not say
};

/// A video device, as narrow as can be: what a test can put a script behind.
class VideoSource {
 public:
  virtual ~VideoSource() = default;
  virtual bool exists() const = 0;
  /// Also after close(). `size`: what the frames should have; a device may choose another one.
  virtual bool open(std::optional<Size> size) = 0;
  virtual void close() noexcept = 0;
  virtual bool set(VideoControl control, double value) = 0;
  /// None if the device has no such control.
  virtual std::optional<double> get(VideoControl control) = 0;
  /// The next frame, oldest first. None if none came.
  virtual std::optional<VideoFrame> grab() = 0;
  virtual std::chrono::microseconds now() const = 0;
  virtual void wait(std::chrono::microseconds time) = 0;
};

/// A device of Video4Linux through OpenCV. `path`: "/dev/v4l/by-id/usb-...", which stays the same when it is
/// plugged in elsewhere, or "/dev/video0".
std::unique_ptr<VideoSource> openCvVideoSource(const std::string& path);

}  // namespace relucent::devices
