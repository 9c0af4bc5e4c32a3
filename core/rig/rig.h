// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/raster.h"
#include "relucent/image/image.h"

namespace relucent::rig {

/// Names a shot within a calibration: "acquisition" 17. Also the key of a simulated device's noise, so that a
/// repeated shot has the same noise.
struct ShotId {
  std::string stage;
  int number = 0;
  bool operator==(const ShotId&) const = default;
};

/// A projector: a raster whose pixels are driven with encoded values.
class Projector {
 public:
  virtual ~Projector() = default;

  virtual std::string name() const = 0;
  virtual Size size() const = 0;
  /// Bits of the drive values: 2^bits - 1 is full drive.
  virtual int bits() const = 0;

  /// Shows encoded drive values in [0, 1] (3 channels, this size), rounded to the projector's codes. Returns
  /// when the picture is lit: every exposure that starts afterwards sees this picture and nothing older.
  /// Throws: Error{device}.
  virtual void show(const image::Image& encodedDrive) = 0;
};

/// Range of exposure times of a camera.
struct ExposureRange {
  double shortest = 0.0;  // seconds
  double longest = 0.0;
};

/// A rectangle of a camera's pixels.
struct PicturePart {
  Pixel begin;
  Size size;
  bool operator==(const PicturePart&) const = default;
};

/// A request for a photograph.
struct CaptureRequest {
  ShotId shot;
  int exposure = 0;      // index within the shot's bracket
  double seconds = 0.0;  // requested exposure time
  /// What of the photograph is looked at; none: all. Pixels beside it may be 0: a camera that need not read
  /// them is faster.
  std::optional<PicturePart> part{};
};

/// One photograph as delivered by the camera.
struct RawFrame {
  image::Image signal;   // 3 channels, full scale 1; linear unless the camera has a response curve
  int bits = 0;          // signal * (2^bits - 1) are integers; 0: floating point
  double seconds = 0.0;  // exposure time that the camera reports
};

/// A camera with manual exposure.
class Camera {
 public:
  virtual ~Camera() = default;

  virtual std::string name() const = 0;
  virtual Size size() const = 0;
  virtual ExposureRange exposures() const = 0;

  /// A frame exposed entirely after this call began.
  /// Throws: Error{device} if none arrives, Error{input} if it is unusable (size, channels, NaN).
  virtual RawFrame capture(const CaptureRequest& request) = 0;
};

/// The devices of a venue: k projectors and r cameras.
struct Rig {
  std::vector<std::unique_ptr<Projector>> projectors;
  std::vector<std::unique_ptr<Camera>> cameras;

  /// The pixels of all projectors, numbered consecutively: the columns of T.
  Rasters projectorRasters() const;
  /// The pixels of all cameras, numbered consecutively: the rows of T.
  Rasters cameraRasters() const;
};

/// Throws: Error{input} if two cameras are one device: names are addresses, or hold the serial number.
void checkDevices(const Rig& rig);

/// Throws: Error{input} unless `frame` has `size`, three channels and only finite values.
void checkFrame(const RawFrame& frame, Size size, const std::string& camera);

}  // namespace relucent::rig
