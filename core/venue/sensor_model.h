// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/image/image.h"
#include "relucent/rig/rig.h"
#include "relucent/venue/venue.h"

namespace relucent::venue {

/// How a camera turns light into a photograph. Cameras of one seed have noise of their own; the lamps' power
/// is the same for all.
///   z = radiance * seconds;  z' = z + N(0, z / fullWell + (read / fullWell)^2), clipped to [0, 1]
///   signal = z'^(1 / cameraGamma), rounded to codes
class SensorModel {
 public:
  SensorModel(const DeviceModelSettings& settings, std::uint64_t seed, std::size_t camera = 0);

  /// The photograph that `request` asks for. The noise depends on the request and the seed alone.
  /// Shapes: radiance of size.count() pixels, three channels.
  rig::RawFrame expose(const CameraStack& radiance, Size size, const rig::CaptureRequest& request) const;

  /// Relative power of the lamp while `request` is exposed: drift and flicker.
  double lampPower(const rig::CaptureRequest& request) const;

  /// The actual exposure time for a requested one of `seconds`.
  static double granted(double seconds);
  static rig::ExposureRange exposures() { return {1.0 / 8000.0, 4.0}; }

 private:
  DeviceModelSettings settings_;
  std::uint64_t seed_, camera_;
};

}  // namespace relucent::venue
