// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/hdr/hdr.h"
#include "relucent/rig/shot.h"

namespace relucent::linearization {

/// How much more light the photographs have at a level than the curve; 0 where they do not say.
struct LevelResidual {
  double drive = 0.0;  // encoded
  double light = 0.0;  // relative to full
  bool operator==(const LevelResidual&) const = default;
};

/// Per projector and channel: encoded drive -> relative radiance.
struct ProjectorResponse {
  std::array<hdr::ResponseCurve, 3> channels;
  /// Per channel, of every measured level: a curve has fewer samples where neighbouring levels were pooled to
  /// make it rise. Empty: not recorded.
  std::array<std::vector<LevelResidual>, 3> residuals{};

  /// Encoded drive for linear values; clamps to [0, 1].
  /// Large images go through tables: the resulting light, decode(encode(L)), is within
  /// sqrt(L) / 2000 of L for every curve, and within 1e-6 for smooth ones. 0 and 1 are exact.
  image::Image encode(const image::Image& linear) const;
  /// Linear values of encoded drive, exact; clamps to [0, 1].
  image::Image decode(const image::Image& encoded) const;
};

struct LinearizationSettings {
  int levels = 33;                 // ramp levels per channel
  double shadowPower = 2.0;        // level k at (k / (levels - 1))^shadowPower: denser in the shadows
  int noisePairs = 2;              // pairs of equal shots for the camera noise model; two are shot anyway
  double additivityLimit = 0.025;  // larger relative deviations are a finding
  double exposureUnit = 0.0;       // exposures are whole multiples, seconds: a lamp's period; 0: any
  std::uint64_t seed = 1;          // of the mosaics
};
/// What is wrong with the settings; empty: nothing.
std::vector<Message> problems(const LinearizationSettings& settings);

/// Results of the calibration of projectors and cameras.
struct Linearization {
  std::vector<ProjectorResponse> projectors;
  /// With the true exposure times (CameraModel::times), relative to the shortest of `exposures`.
  std::vector<hdr::CameraModel> cameras;
  /// Exposure times, longest first, that cover this venue: the flood image just unsaturated at the shortest,
  /// dim interreflections above the noise at the longest. Only one if the camera has no longer one.
  std::vector<double> exposures;
  /// Per projector: largest relative deviation of white from red + green + blue, and of the flood image from
  /// the sum of its parts.
  std::vector<double> additivityError;
  /// Time that its shots took: a benchmark of the devices. Shots read from a log do not count.
  rig::ShotTimes times;
  /// Light under black projectors, the room's included, relative to that under white ones, as all cameras see
  /// it; none: not recorded.
  std::optional<double> blackShare{};
  /// Findings (a white segment, a picture mode, flicker); empty: none.
  std::vector<Message> findings;
};

/// Measures projectors and cameras:
///  1. exposures: the 99.5th percentile of the flood image at 0.8 of saturation; 12 times that for
///     what is dim; both within what the cameras can do;
///  2. cameras: saturation, response (linear unless white at these exposures shows otherwise), true exposure
///     times; noise at the end, from pairs of equal shots;
///  3. projectors: mosaics that show many levels at once, those of all projectors in the same photographs,
///     and each of its lights alone; the responses that explain all of them, with the lamps' drift and
///     flicker, by regression; isotonic regression, monotone cubic;
///  4. from the same shots: white against red + green + blue, the whole against its parts, the response of
///     parts of the picture against that of the whole.
/// Some 30 photographs for one projector and a linear camera, 10 more for a second projector, 7 for each
/// further one. Source: core/linearization/README.md. Throws: Error{input} if a camera sees no difference
/// between black and white, or no camera sees a projector's channel; Error{device, disk}; Cancelled.
Linearization linearize(rig::ShotTaker& shots, const LinearizationSettings& settings, Progress& progress);

/// Patterns that linearize() usually shows: for what people are told before.
int usualShots(const LinearizationSettings& settings, std::size_t projectors);

}  // namespace relucent::linearization
