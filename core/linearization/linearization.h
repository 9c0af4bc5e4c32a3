// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hdr/hdr.h"

namespace relucent {

/// Per projector and channel: encoded drive -> relative radiance.
struct ProjectorResponse {
  std::array<ResponseCurve, 3> channels;

  /// Encoded drive for linear values; clamps to [0, 1].
  Image encode(const Image& linear) const;
  Image decode(const Image& encoded) const;
};

struct LinearizationSettings {
  int levels = 33;                 // ramp levels per channel
  double shadowPower = 2.0;        // level k at (k / (levels - 1))^shadowPower: denser in the shadows
  int noisePairs = 4;              // pairs of equal shots for the camera noise model
  double additivityLimit = 0.025;  // larger relative deviations are a finding
  std::uint64_t seed = 1;          // order of the ramp
};
std::vector<std::string> problems(const LinearizationSettings& settings);

/// What calibration of both ends of the light path found.
struct Linearization {
  std::vector<ProjectorResponse> projectors;
  std::vector<CameraModel> cameras;
  /// Exposure times, longest first, that cover this venue: the flood image just unsaturated at the shortest,
  /// dim interreflections above the noise at the longest.
  std::vector<double> exposures;
  /// Per projector: largest relative deviation of white from red + green + blue, and of random sums.
  std::vector<double> additivityError;
  /// Sentences about what was found wrong (a white segment, a picture mode, a flicker); empty: nothing.
  std::vector<std::string> findings;
};

/// Measures exposures, camera noise, projector ramps and additivity, in this order.
/// Throws: Error{input} if the camera sees no difference between black and white; Error{device}; Cancelled.
Linearization linearize(ShotTaker& shots, const LinearizationSettings& settings, Progress& progress);

}  // namespace relucent
