// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "relucent/image/image.h"
#include "relucent/venue/venue.h"

namespace relucent::venue {

/// How a projector turns encoded drive into light: codes, a response curve per channel, a white segment.
class ProjectorModel {
 public:
  explicit ProjectorModel(const DeviceModelSettings& settings);

  int bits() const { return bits_; }
  /// Relative linear light per channel, 0 to 1, for drive in [0, 1] rounded to codes. Three channels each.
  CameraStack light(const image::Image& encodedDrive) const;
  /// The response of one channel, strictly increasing from 0 at 0 to 1 at 1; no pure power law.
  double response(std::size_t channel, double drive) const;
  /// What every channel emits at code 0, relative to full drive.
  const std::array<float, 3>& black() const { return black_; }

 private:
  int bits_;
  double gamma_;
  bool whiteSegment_;
  std::array<float, 3> black_;
  std::array<std::vector<float>, 3> lightOfCode_;
};

}  // namespace relucent::venue
