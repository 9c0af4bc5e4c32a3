// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "transport/transport_matrix.h"

namespace relucent {

/// What compensation needs to know of a measured venue, whoever measured it.
struct MeasuredVenue {
  TransportMatrix transport;
  Stack black;                       // e
  Stack flood;                       // T 1 as photographed
  std::vector<std::uint8_t> usable;  // per camera pixel: lit by the projector and not flagged
};

struct TargetSettings {
  /// Corners of the content in the first camera's view, pixels, clockwise from top left; none: the largest
  /// upright rectangle of the content's shape that lies in usable pixels.
  std::optional<std::array<std::array<double, 2>, 4>> corners;
  double reachablePercentile = 15.0;  // share of pixels (percent) that may be too dark to show white
  double blackLift = 0.0;             // share of white added to black
};
std::vector<std::string> problems(const TargetSettings& settings);

/// The image wanted at the camera.
struct Target {
  Stack wanted;                         // camera signal per second
  std::vector<std::uint8_t> inside;     // per camera pixel: the content covers it
  std::vector<std::uint8_t> reachable;  // per camera pixel inside: e <= wanted <= T 1 + e in all channels
  std::vector<float> weight;            // per camera pixel: 1 inside, less where unreachable, 0 outside
  std::array<float, 3> white{};         // wanted signal of the content's white: the peak for PSNR
};

/// Places and scales linear content (values 0 to 1) into what the camera should see.
///   wanted = white * K content,  K = the venue's mean row-normalised colour mixing, so that content's
///   colours
/// keep the projector's hues and white stays neutral. Brightness: from the reachability map.
Target fitTarget(const Image& linearContent, const MeasuredVenue& venue, const TargetSettings& settings);

}  // namespace relucent
