// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "relucent/rig/rig.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::test {

/// An ascending function on [0, 1].
using Curve = std::function<double(double)>;
Curve identityCurve();
Curve gammaCurve(double gamma);
/// A smooth S with a toe and a shoulder, far from any power law.
Curve sCurve(double strength = 0.6);

/// How a scripted projector behaves.
struct ScriptedProjector {
  int bits = 8;
  std::array<Curve, 3> curves{gammaCurve(2.2), gammaCurve(2.2), gammaCurve(2.2)};  // drive -> radiance
  double whiteSegment = 0.0;  // light added where all channels are lit: this times their smallest
  double brightness = 1.0;    // of its light, times what the transport says
  double drift = 0.0;         // of its own lamp, besides that of all: relative change over 1000 shots
  double flicker = 0.0;       // likewise: relative deviation between exposures
};

/// How a scripted camera behaves.
struct ScriptedCamera {
  int bits = 12;  // 0: floating point, no rounding
  rig::ExposureRange exposures{1e-4, 8.0};
  double readNoise = 1e-3;  // standard deviation, full scale 1; rounding comes on top
  double gain = 1e-4;       // photon noise: variance per linear signal
  double timeError = 0.0;   // true exposure times are off by up to this, the same for equal times
  double pedestal = 0.0;    // noise below black survives down to minus this; 0: cut at zero
  Curve response{};         // linear signal -> signal; empty: linear
};

struct ScriptedSettings {
  std::vector<ScriptedProjector> projectors;  // the last stands for all that follow; empty: defaults
  std::vector<ScriptedCamera> cameras;        // likewise
  CameraStack ambient;                        // radiance that no projector makes; empty: none
  double drift = 0.0;                         // relative change of lamp power over 1000 shots
  double flicker = 0.0;                       // relative deviation of lamp power between exposures
  std::uint64_t seed = 1;                     // of all noise
  /// Called before every exposure: counts, asks to stop, throws.
  std::function<void(const rig::CaptureRequest&)> beforeCapture;
};

/// Devices that answer from a given light transport,
///   signal = round(response(seconds * (lamp * (T * decode(drive) + black) + ambient) + noise)).
/// Noise depends on seed, shot, exposure and pixel only: an exposure taken again is the same bits.
class ScriptedVenue {
 public:
  /// `black`: radiance of the projectors' black levels at full lamp power; empty: none.
  ScriptedVenue(transport::TransportMatrix transport, CameraStack black, ScriptedSettings settings = {});

  /// Devices that share this venue's data and may outlive it.
  rig::Rig rig() const;

  const transport::TransportMatrix& transport() const;
  /// Radiance without any light from patterns: black + ambient.
  CameraStack black() const;
  /// Linear drive that encoded patterns make, rounded to codes, without a white segment.
  ProjectorStack linearDrive(const std::vector<image::Image>& encodedPatterns) const;
  /// True radiance, camera signal per second, at full lamp power, free of noise.
  CameraStack radiance(const std::vector<image::Image>& encodedPatterns) const;
  /// Exposures taken so far.
  int captures() const;

  struct State;

 private:
  std::shared_ptr<State> state_;
};

/// A made-up light transport with the traits of a real one, for tests that need no scene.
struct SyntheticSettings {
  std::vector<Size> projectors{{32, 24}};
  std::vector<Size> cameras{{40, 30}};
  double footprint = 0.7;        // standard deviation of a camera pixel's footprint, in projector pixels
  double crosstalk = 0.08;       // share of each projector channel that lands in each other camera channel
  double interreflection = 0.0;  // far-field light as a share of a pixel's direct light
  int interreflectionLevel = 3;  // pyramid level whose nodes carry the far field; finer levels are direct
  double brightness = 20.0;      // radiance of a white surface under full white, camera signal per second
  bool sideBySide = false;       // projectors share out the camera's width; or each fills all of it
  double shareSeen = 0.9;  // of the camera's width that the projection fills; the rest sees far field only
  std::uint64_t seed = 1;
};

/// Per camera pixel and projector: a Gaussian footprint around a smooth, slightly warped correspondence,
/// scaled by a textured reflectance and a 3x3 mixing, and, if wanted, a far field on coarse nodes.
/// All values are positive. Same settings, same bits.
transport::TransportMatrix syntheticTransport(const SyntheticSettings& settings);

/// An even black level: `share` of the mean flood radiance, slightly textured.
CameraStack syntheticBlack(const transport::TransportMatrix& transport, double share = 1e-3);

}  // namespace relucent::test
