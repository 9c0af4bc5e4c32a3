// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>

#include "relucent/acquisition/settings.h"
#include "relucent/acquisition/tree_context.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::acquisition {

/// Sums over patterns, of one camera pixel or of all.
struct Residual {
  double squared = 0.0;    // of measured - predicted
  double variance = 0.0;   // expected of that, from noise alone
  double light = 0.0;      // squared, of measured - e
  double predicted = 0.0;  // squared, of T p
  double noise = 0.0;      // the photographs' part of `variance`

  double relative() const { return light > 0.0 ? std::sqrt(squared / light) : 0.0; }
  /// (measured - e) * T p, summed.
  double cross() const { return 0.5 * (light + predicted - squared); }
  /// What `squared` would be if the lamp's power were `power` times what it was: of measured - e - power T p.
  double squaredAt(double power) const {
    return std::max(0.0, light - 2.0 * power * cross() + power * power * predicted);
  }
  void add(const Residual& other);
};

/// Whether a residual is large both as a share of the light and beyond its noise.
bool isWrong(const Residual& residual, const AcquisitionSettings& settings);

/// |measured - predicted| / |measured - e| over all camera pixels.
double errorOf(const std::vector<Residual>& rows);

/// How well T predicts photographs that it was not made from.
struct Verification {
  std::vector<Residual> rows;                      // per camera pixel; zeros where it did not count
  std::array<Residual, verificationSizes> bySize;  // per block size, all camera pixels
  CameraMask flagged;  // per camera pixel: wrong both relatively and beyond its noise
  std::vector<CameraStack>
      residual;  // per block size: root of the mean square of measured - predicted, radiance
};

/// What `from` found of the chosen camera pixels, in the place of what `into` did; not of the sums of all.
void replaceRows(Verification& into, const Verification& from, const CameraMask& chosen);

/// The light of a pattern, radiance less e. Whoever has photographed it keeps it, or not.
using SeenLight = std::shared_ptr<const hdr::LampLight>;
using LightSource = std::function<sentinels::Interruptible<SeenLight>(
    const ProjectorStack& pattern, const std::vector<photography::Demand>& demands)>;

/// What a held-out photograph is compared with, and how good it has to be.
struct Expectation {
  const transport::TransportMatrix& transport;
  const CameraStack& black;             // e
  const std::vector<float>& tolerable;  // deviation of a frame that is good enough, per camera pixel
};

/// Which patterns are photographed, and what counts as wrong.
struct VerificationTask {
  const AcquisitionSettings& settings;
  const std::vector<std::uint8_t>& rows;  // the camera pixels that count
  int first = 0;                          // number of the first pattern: another round sees other patterns
};

/// Photographs random binary patterns of blocks of 1, 2, 4 and 8 pixels, every channel of every block lit or
/// not by chance, and compares them with T p. Of a T in blocks, which cannot tell what is inside them, none
/// is finer than its finest. Returns: as `light`.  Throws: what that throws; Cancelled.
sentinels::Interruptible<Verification> verify(const Expectation& expected, const LightSource& light,
                                              const VerificationTask& task, Progress& progress);
/// The same while T is being measured. Throws: as Watch::check().
sentinels::Interruptible<Verification> verify(const transport::TransportMatrix& transport,
                                              const TreeContext& context, const VerificationTask& task,
                                              Progress& progress);

/// The pattern `number` of those, in blocks of at least `least` pixels: a projector stack of zeros and ones.
ProjectorStack verificationPattern(const Rasters& projectors, int number, std::uint64_t seed, int least = 1);

}  // namespace relucent::acquisition
